//! Parameters of a drawing in the flat form `path → value`, whatever form the drawing had.

use serde_json::{Map, Value};

/// Parameters without one path, whether it was written as one dotted key or nested.
pub(super) fn without(params: &Map<String, Value>, path: &str) -> Map<String, Value> {
    let mut out = params.clone();
    remove(&mut out, path);
    out
}

fn remove(params: &mut Map<String, Value>, path: &str) {
    params.remove(path);
    for (end, _) in path.match_indices('.') {
        let (head, rest) = (&path[..end], &path[end + 1..]);
        if let Some(Value::Object(inner)) = params.get_mut(head) {
            remove(inner, rest);
            if inner.is_empty() {
                params.remove(head);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_parameter_is_removed_in_any_spelling() {
        let spellings = [
            json!({"a.b.c": 1, "a.b.d": 2}),
            json!({"a": {"b": {"c": 1, "d": 2}}}),
            json!({"a.b": {"c": 1, "d": 2}}),
            json!({"a": {"b.c": 1, "b.d": 2}}),
        ];
        for spelling in spellings {
            let left = without(spelling.as_object().unwrap(), "a.b.c");
            assert!(!Value::from(left.clone()).to_string().contains('c'), "{left:?}");
            assert!(Value::from(left).to_string().contains('d'));
        }
        assert!(without(json!({"a": {"b": 1}}).as_object().unwrap(), "a.b").is_empty());
    }
}
