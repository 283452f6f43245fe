//! Random layouts and values of them, the same in every run.

use serde_json::{Map, Value, json};

/// Names of fields, as Rust and JSON have them.
const NAMES: [&str; 10] = [
    "x",
    "heading",
    "ballSeen",
    "class",
    "x_",
    "__odd",
    "9lives",
    "kebab-case",
    "data",
    "größe",
];

/// Numbers that are mixed well enough for tests (splitmix64).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    pub(crate) fn below(&mut self, end: usize) -> usize {
        usize::try_from(self.next() % end.max(1) as u64).expect("it is small")
    }

    pub(crate) fn bytes(&mut self, most: usize) -> Vec<u8> {
        (0..self.below(most)).map(|_| self.byte()).collect()
    }

    pub(crate) fn byte(&mut self) -> u8 {
        self.next().to_le_bytes()[0]
    }

    /// With parts at most so deep in each other.
    pub(crate) fn layout(&mut self, depth: usize) -> Value {
        json!({ "root": self.part(depth) })
    }

    fn part(&mut self, depth: usize) -> Value {
        let kinds = if depth == 0 { 6 } else { 13 };
        match self.below(kinds) {
            0 => json!({ "kind": "bool" }),
            1 => json!({ "kind": "float", "bits": ([32, 64][self.below(2)]) }),
            2 => json!({ "kind": "signed", "bits": ([8, 16, 32, 64][self.below(4)]) }),
            3 => json!({ "kind": "unsigned", "bits": ([8, 16, 32, 64][self.below(4)]) }),
            4 => json!({ "kind": "text" }),
            5 => {
                json!({ "kind": "enum", "variants": [{ "name": "Off" }, { "name": "on-air" }, { "name": "ON_AIR" }] })
            }
            6 => json!({ "kind": "unit" }),
            7 => {
                let content = self.part(depth - 1);
                match content["kind"].as_str() {
                    // In JSON nobody can tell what is not there from what is there and nothing.
                    Some("unit" | "option") => content,
                    _ => json!({ "kind": "option", "content": content }),
                }
            }
            8 => json!({ "kind": "list", "item": self.part(depth - 1) }),
            9 => {
                json!({ "kind": "array", "length": self.below(4), "item": self.part(depth - 1) })
            }
            10 => {
                let items = (0..self.below(4)).map(|_| self.part(depth - 1));
                json!({ "kind": "tuple", "items": items.collect::<Vec<_>>() })
            }
            _ => {
                let first = self.below(NAMES.len());
                let names = NAMES.iter().cycle().skip(first);
                let names = names.take(self.below(5)).collect::<Vec<_>>();
                let fields = names.iter().map(|name| {
                    let optional = self.below(5) == 0;
                    json!({ "name": name, "layout": self.part(depth - 1), "optional": optional })
                });
                json!({ "kind": "struct", "fields": fields.collect::<Vec<_>>() })
            }
        }
    }

    /// A value of this part, beside its bytes as the robot has them and its leaves in their order.
    pub(crate) fn value(&mut self, part: &Value, into: &mut Written) -> Value {
        let kind = part["kind"].as_str().expect("every part has a kind");
        let bits = part["bits"].as_u64().unwrap_or_default();
        match kind {
            "bool" => {
                let value = self.below(2) == 1;
                into.leaf(&[u8::from(value)], value.into())
            }
            "float" if bits == 32 => {
                #[expect(clippy::cast_precision_loss, reason = "any number will do")]
                let value = (self.next() as i64) as f32 / 1e12;
                into.leaf(&value.to_le_bytes(), f64::from(value).into())
            }
            "float" => {
                #[expect(clippy::cast_precision_loss, reason = "any number will do")]
                let value = (self.next() as i64) as f64 / 1e12;
                into.leaf(&value.to_le_bytes(), value.into())
            }
            "signed" => {
                let value = (self.next() as i64) >> (64 - bits);
                into.leaf(lowest(&value.to_le_bytes(), bits), value.into())
            }
            "unsigned" => {
                let value = self.next() >> (64 - bits);
                into.leaf(lowest(&value.to_le_bytes(), bits), value.into())
            }
            "text" => {
                let value = ["", "a", "né", "ros 2"][self.below(4)];
                into.count(value.len());
                into.leaf(value.as_bytes(), value.into())
            }
            "enum" => {
                let variant = self.below(3);
                into.count(variant);
                into.leaves.push(variant.into());
                part["variants"][variant]["name"].clone()
            }
            "unit" => Value::Null,
            "option" => {
                let is_there = self.below(2) == 1;
                into.bytes.push(u8::from(is_there));
                match is_there {
                    true => self.value(&part["content"], into),
                    false => Value::Null,
                }
            }
            "list" => {
                let count = self.below(4);
                into.count(count);
                (0..count)
                    .map(|_| self.value(&part["item"], into))
                    .collect()
            }
            "array" => {
                let length = part["length"].as_u64().expect("arrays have a length");
                (0..length)
                    .map(|_| self.value(&part["item"], into))
                    .collect()
            }
            "tuple" => {
                let items = part["items"].as_array().expect("tuples have items");
                items.iter().map(|item| self.value(item, into)).collect()
            }
            _ => {
                let mut object = Map::new();
                for field in part["fields"].as_array().expect("structs have fields") {
                    if field["optional"] == true {
                        let is_there = self.below(2) == 1;
                        into.bytes.push(u8::from(is_there));
                        if !is_there {
                            continue;
                        }
                    }
                    let name = field["name"].as_str().expect("fields have names");
                    object.insert(name.to_owned(), self.value(&field["layout"], into));
                }
                Value::Object(object)
            }
        }
    }
}

/// A value in the robot's bytes, and its numbers and texts alone.
#[derive(Default)]
pub(crate) struct Written {
    pub(crate) bytes: Vec<u8>,
    pub(crate) leaves: Vec<Value>,
}

impl Written {
    fn leaf(&mut self, bytes: &[u8], value: Value) -> Value {
        self.bytes.extend_from_slice(bytes);
        self.leaves.push(value.clone());
        value
    }

    fn count(&mut self, count: usize) {
        let count = u32::try_from(count).expect("it is small");
        self.bytes.extend_from_slice(&count.to_le_bytes());
    }
}

fn lowest(bytes: &[u8], bits: u64) -> &[u8] {
    &bytes[..usize::try_from(bits / 8).expect("it is small")]
}
