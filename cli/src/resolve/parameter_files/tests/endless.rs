//! Types that lead to ever new ones come to an end.

use super::robot;
use crate::diagnostics::Diagnostics;
use crate::pipeline;
use crate::workspace::Workspace;

/// Parameters of this type that are left to serde.
fn opaque(data: &str, types: &str) -> Vec<String> {
    let field = format!("a: Parameter<made::{data}, \"a\">,");
    let fixture = robot(&field, "")
        .file("crates/types/src/lib.rs", "pub mod made;")
        .file("crates/types/src/made.rs", types)
        .file("parameters/default.toml", "");
    let workspace = Workspace::in_memory(fixture.files());
    let understood = pipeline::understand(&workspace, &mut Diagnostics::new());
    understood.expect("only files lack").unchecked.opaque
}

#[test]
fn structs_that_stand_twice_in_each_other_are_judged_once() {
    let types: String = (0..30)
        .map(|own| {
            format!(
                "#[derive(Deserialize)] pub struct S{own} {{ pub a: S{0}, pub b: S{0} }} ",
                own + 1
            )
        })
        .collect();
    let last = "#[derive(Deserialize)] pub struct S30 { pub v: f32 }";
    assert!(opaque("S0", &format!("{types}{last}")).is_empty());
}

#[test]
fn what_leads_to_ever_new_types_is_opaque() {
    let types = "#[derive(Deserialize)] pub struct P<T> \
                 { pub v: T, pub n: Option<Box<P<Vec<T>>>>, pub m: Option<Box<P<Option<T>>>> }";
    assert_eq!(opaque("P<f32>", types), ["a"]);
}
