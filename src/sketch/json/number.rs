//! Numbers as files have them.

/// Shortest decimal that reads back to `number`; whole numbers without `.0`.
pub(in crate::sketch) fn push_number(out: &mut String, number: f32) {
    let mut buffer = ryu::Buffer::new();
    let text = buffer.format(number);
    out.push_str(text.strip_suffix(".0").unwrap_or(text));
}
