type A = ((((u8))));
#[path = "node.rs"]
pub mod node;
