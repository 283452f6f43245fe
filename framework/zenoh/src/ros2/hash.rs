//! The hash by which ROS 2 knows a type: SHA-256 of its description, in the one form that REP-2011 allows (RIHS01).

use std::fmt::Write as _;

use sha2::{Digest as _, Sha256};

use super::messages::{Field, Kind, Many, Message};

/// The field of a message that has none.
const FILLER: Field = Field {
    name: String::new(),
    kind: Kind::Base("uint8"),
    many: Many::One,
};

/// `RIHS01_…` of a type that consists of these others.
pub(crate) fn hash(root: &Message, nested: &[Message]) -> String {
    let mut nested: Vec<&Message> = nested.iter().collect();
    nested.sort_by(|one, other| one.name.cmp(&other.name));
    let nested: Vec<String> = nested.into_iter().map(description).collect();
    let text = format!(
        r#"{{"type_description": {}, "referenced_type_descriptions": [{}]}}"#,
        description(root),
        nested.join(", ")
    );
    let mut hash = "RIHS01_".to_owned();
    for byte in Sha256::digest(text) {
        let _ = write!(hash, "{byte:02x}");
    }
    hash
}

fn description(message: &Message) -> String {
    let mut fields: Vec<String> = message
        .fields
        .iter()
        .map(|one| field(&one.name, one))
        .collect();
    if fields.is_empty() {
        fields.push(field("structure_needs_at_least_one_member", &FILLER));
    }
    format!(
        r#"{{"type_name": "{}", "fields": [{}]}}"#,
        message.name,
        fields.join(", ")
    )
}

fn field(name: &str, field: &Field) -> String {
    let (number, nested) = match &field.kind {
        Kind::Base(base) => (number(base), ""),
        Kind::Message(name) => (1, name.as_str()),
    };
    let (several, capacity) = match field.many {
        Many::One => (0, 0),
        Many::Array(length) => (48, length),
        Many::AtMost(most) => (96, most),
        Many::Any => (144, 0),
    };
    let number = number + several;
    format!(
        r#"{{"name": "{name}", "type": {{"type_id": {number}, "capacity": {capacity}, "string_capacity": 0, "nested_type_name": "{nested}"}}}}"#
    )
}

/// As type_description_interfaces/msg/FieldType numbers them.
fn number(base: &str) -> u32 {
    match base {
        "int8" => 2,
        "uint8" => 3,
        "int16" => 4,
        "uint16" => 5,
        "int32" => 6,
        "uint32" => 7,
        "int64" => 8,
        "uint64" => 9,
        "float32" => 10,
        "float64" => 11,
        "bool" => 15,
        "string" => 17,
        // No other kind is made.
        _ => 0,
    }
}
