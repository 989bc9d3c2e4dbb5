//! The places of a garden as JSON, for programs that have plants of their own: what there is of each kind, and where it stands.
//!
//! A plant a line: its kind and individual, counted from 0, the place of its foot in metres with y up, its turn as a
//! quaternion (x, y, z, w), and its size.

use super::plan::Place;
use super::scene::Garden;
use serde_json::{Value, json};

impl Garden {
    /// The list.
    pub fn list(&self) -> Vec<u8> {
        let kinds: Vec<Value> = self
            .stock
            .kinds
            .iter()
            .map(|kind| {
                let individuals = kind.individuals.iter().map(
                    |individual| json!({ "triangles": individual.triangle_count(), "height": individual.height() }),
                );
                json!({ "name": kind.name, "individuals": individuals.collect::<Vec<_>>() })
            })
            .collect();
        let head = json!({ "format": "penstemon-garden", "version": 1, "kinds": kinds }).to_string();
        let mut text = head;
        text.truncate(text.len() - 1);
        text.push_str(",\n\"plants\":[");
        for (number, place) in self.places.iter().enumerate() {
            text.push_str(if number > 0 { ",\n" } else { "\n" });
            text.push_str(&line(place).to_string());
        }
        text.push_str("\n]}\n");
        text.into_bytes()
    }
}

fn line(&Place { kind, variant, at, rotation, scale }: &Place) -> Value {
    json!({ "kind": kind, "individual": variant, "at": at.to_array(), "rotation": rotation.to_array(), "scale": scale })
}
