//! This crate is what hulkgen would write now.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::testing;

#[test]
fn the_generated_crate_is_current() {
    testing::assert_generated(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
}
