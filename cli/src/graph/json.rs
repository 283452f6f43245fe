//! The graph as JSON, and the hash by which recordings and clients recognise it.

use serde_json::Value;

use super::Graph;

/// The JSON form, one key a line.
pub fn render(graph: &Graph) -> String {
    let mut text = serde_json::to_string_pretty(graph).expect("a graph has only string keys");
    text.push('\n');
    text
}

/// FNV-1a (64 bit, hexadecimal) of the compact JSON form without the key `hash` and without the
/// lines of fields: a comment in a node's file is no other graph.
pub fn hash(graph: &Graph) -> String {
    let mut value = serde_json::to_value(graph).expect("a graph has only string keys");
    remove_incidental(&mut value);
    format!("{:016x}", fnv_1a(value.to_string().as_bytes()))
}

fn remove_incidental(value: &mut Value) {
    match value {
        Value::Object(entries) => {
            entries.shift_remove("hash");
            entries.shift_remove("line");
            entries.values_mut().for_each(remove_incidental);
        }
        Value::Array(values) => values.iter_mut().for_each(remove_incidental),
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => {}
    }
}

/// Offset basis and prime of the 64-bit FNV-1a function.
fn fnv_1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::fnv_1a;

    #[test]
    fn the_hash_is_fnv_1a() {
        assert_eq!(fnv_1a(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv_1a(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(fnv_1a(b"foobar"), 0x8594_4171_f739_67e8);
    }
}
