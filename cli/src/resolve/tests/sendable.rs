//! Nodes whose state keeps them on one thread.

use super::ACTS;
use crate::scan::fixture::{Fixture, Node};

/// A node with these fields in its state, a `restore`, and this code above it.
fn fixture(state: &str, head: &str) -> Fixture {
    let node = Node {
        state,
        head,
        more: "pub fn restore(&mut self, context: CreationContext) -> Result<()> {}",
        ..ACTS
    };
    Fixture::control(&["a"]).node("a", node)
}

#[test]
fn what_is_surely_not_send_is_told_at_the_field() {
    fixture("#[serde(skip)] x: Option<std::rc::Rc<u8>>,", "").expect(
        "unsendable-state",
        &[
            "the node `Node` cannot be moved to the thread of its cycler",
            "crates/nodes/src/a.rs:",
            "`std::rc::Rc<u8>` is not `Send`",
            "`Arc` for `Rc`",
        ],
    );
    for (field, blame) in [
        ("Option<*const u8>", "`*const u8`"),
        ("Option<Box<dyn Fn()>>", "`dyn Fn ()` is not"),
        ("Vec<(u8, dyn hardware::Plain)>", "`dyn hardware::Plain`"),
        ("Box<dyn hardware::Marked + Sync>", "Marked + Sync` is not"),
        ("&'static dyn hardware::Motors", "Motors` is not"),
        ("Option<std::sync::MutexGuard<'static, u8>>", "MutexGuard"),
        ("std::sync::Arc<std::cell::RefCell<u8>>", "RefCell<u8>"),
        ("&'static std::cell::Cell<u8>", "Cell<u8>"),
        ("std::sync::Mutex<S<u8>>", "`R<T>` is not"),
        ("Within", "`Rc<u8>` in `nodes::a::Within` is not"),
        ("Generic<S<u8>>", "in `nodes::a::Generic`"),
        ("Many", "in `nodes::a::Many`"),
        ("Default", "`Rc<u8>` in `nodes::a::Default` is not"),
        ("Pair<u8>", "`Rc<T>` in `nodes::a::Pair` is not"),
    ] {
        let head = "
            use std::rc::{Rc, Rc as R};
            type S<T> = R<T>;
            pub struct Within { a: u8, b: Rc<u8> }
            pub struct Generic<T> { inner: Option<T> }
            enum Many { A, B(Rc<u8>) }
            pub struct Default<T = Rc<u8>> { inner: T }
            pub struct Pair<T, U = Rc<T>> { first: T, second: Option<U> }
        ";
        fixture(&format!("#[serde(skip)] x: {field},"), head)
            .file("crates/hardware/src/lib.rs", TRAITS)
            .expect("unsendable-state", &[blame]);
    }
}

const TRAITS: &str = "
    pub trait Motors: Send { fn write(&self, value: u8) -> Result<()>; }
    pub trait Plain { fn x(&self); }
    pub trait Above: Motors + Plain {}
    pub trait Asks where Self: Send {}
    pub trait Marked: Plain {}
";

#[test]
fn what_may_be_send_is_left_to_rustc_and_counted() {
    for (field, head, left) in [
        ("std::cell::RefCell<u8>", "", 0),
        (
            "std::sync::Arc<std::sync::Mutex<std::cell::RefCell<u8>>>",
            "",
            0,
        ),
        ("Box<dyn Fn() + Send>", "", 0),
        ("Box<dyn hardware::Above>", "", 0),
        ("Box<dyn hardware::Marked + Send>", "", 0),
        ("Box<dyn framework::Elsewhere + Send>", "", 0),
        ("Box<dyn framework::Elsewhere>", "", 1),
        ("Box<dyn hardware::Plain + framework::Elsewhere>", "", 1),
        ("Box<dyn hardware::Asks>", "", 1),
        ("fn(std::rc::Rc<u8>)", "", 0),
        ("framework::Elsewhere<std::rc::Rc<u8>>", "", 1),
        ("nalgebra::Isometry2<f32>", "", 0),
        ("elsewhere::Handle", "", 1),
        ("std::vec::IntoIter<std::rc::Rc<u8>>", "", 1),
        ("std::sync::LazyLock<std::rc::Rc<u8>>", "", 1),
        (
            "<u8 as Tr>::Out",
            "trait Tr { type Out; } impl Tr for u8 { type Out = std::rc::Rc<u8>; }",
            1,
        ),
        (
            "Within",
            "struct Within(*const u8); unsafe impl Send for Within {}",
            0,
        ),
        ("Within", "struct Within(*const u8); sends!(Within);", 1),
        ("Within", "#[sends] struct Within(*const u8);", 1),
        ("Within", "struct Within { #[cfg(never)] x: *const u8 }", 1),
        ("Within", "#[derive(Sends)] struct Within(*const u8);", 1),
        ("Within", "#[derive(Sends)] struct Within(u8);", 0),
        ("Within", "enum Within { A, #[cfg(never)] B(*const u8) }", 1),
        (
            "Shared<u8>",
            "#[cfg(never)] use std::rc::Rc as Shared; #[cfg(not(never))] use std::sync::Arc as Shared;",
            1,
        ),
        ("*const u8", "unsafe impl Send for Node {}", 0),
        ("Ring", "struct Ring { next: Option<Box<Ring>> }", 0),
        (
            "Generic<std::rc::Rc<u8>>",
            "struct Generic<T> { inner: framework::Elsewhere<T> }",
            1,
        ),
        (
            "Generic<u8>",
            "struct Generic<T, U = T> { inner: Vec<(T, U)> }",
            0,
        ),
    ] {
        let robot = fixture(&format!("#[serde(skip)] x: {field},"), head)
            .file("crates/hardware/src/lib.rs", TRAITS)
            .robot();
        assert_eq!(robot.besides_edges, left, "{field} {head}");
    }
}
