//! Names in generated code: the only place where casing happens.

use std::collections::BTreeSet;

use serde::Serialize;

use crate::resolve::robot::Node;

pub use schema::{snake_case, upper_camel_case};

/// Names that mean the prelude's to every reader, and `Self`.
pub const PRELUDE: [&str; 26] = [
    "Box", "Clone", "Copy", "Debug", "Default", "Drop", "Eq", "Err", "Fn", "FnMut", "FnOnce",
    "From", "Into", "Iterator", "None", "Ok", "Option", "Ord", "Result", "Self", "Send", "Some",
    "String", "Sync", "ToString", "Vec",
];

/// Types that are no item of any crate.
const PRIMITIVE: [&str; 17] = [
    "bool", "char", "f32", "f64", "i128", "i16", "i32", "i64", "i8", "isize", "str", "u128", "u16",
    "u32", "u64", "u8", "usize",
];

/// Names that every file of nodes defines itself.
const FUNCTIONS_OF_NODES: [&str; 7] = [
    "create",
    "cycle",
    "cycle_closely",
    "inject",
    "new",
    "restore",
    "setup",
];

/// Whether this is `f32` or another type that no `use` has to bring in, but may hide.
pub fn is_primitive(name: &str) -> bool {
    PRIMITIVE.contains(&name)
}

/// Whether a path that begins so begins with a type that is in scope everywhere, and not with a crate: `u8::MAX`.
pub fn begins_with_type(first: &str) -> bool {
    is_primitive(first) || PRELUDE.contains(&first)
}

/// `VisionTop` becomes `VISION_TOP`.
pub fn constant_case(name: &str) -> String {
    snake_case(name).to_uppercase()
}

/// Names given so far in one place; no name is given twice.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Names {
    given: BTreeSet<String>,
}

impl Names {
    /// Names that stand already.
    pub fn with(given: impl IntoIterator<Item = String>) -> Self {
        Self {
            given: given.into_iter().collect(),
        }
    }

    /// The wanted name, or the wanted name and the first number that makes it new.
    pub fn give(&mut self, wanted: &str) -> String {
        self.give_with(wanted, |_| Vec::new())
    }

    /// The same where others come with it, which have to be new, too, and are given at once.
    pub fn give_with(&mut self, wanted: &str, derived: impl Fn(&str) -> Vec<String>) -> String {
        let mut name = wanted.to_owned();
        let mut number = 2;
        loop {
            let mut all = derived(&name);
            all.push(name.clone());
            if all.iter().all(|one| !self.given.contains(one)) {
                self.given.extend(all);
                return name;
            }
            name = format!("{wanted}{number}");
            number += 1;
        }
    }
}

/// What the nodes of one cycler are called there: the last name of their path, or the whole path
/// where another node ends in the same name.
///
/// A node `x` has the functions `x` and `create_x`; no function of one node is another's.
pub fn name_nodes(nodes: &[Node]) -> Vec<String> {
    let shorts: Vec<&str> = nodes.iter().map(|node| plain(last(&node.path))).collect();
    let wanted: Vec<String> = nodes
        .iter()
        .zip(&shorts)
        .map(|(node, short)| {
            let unique = shorts.iter().filter(|other| *other == short).count() == 1;
            if unique {
                (*short).to_owned()
            } else {
                node.path.replace("r#", "").replace("::", "_")
            }
        })
        .collect();
    let created: BTreeSet<String> = wanted.iter().map(|name| create(name)).collect();
    let mut taken: BTreeSet<String> = FUNCTIONS_OF_NODES.map(str::to_owned).into();
    let mut names = Vec::new();
    for wanted in wanted {
        let mut name = wanted.clone();
        let mut number = 1;
        while created.contains(&name) || taken.contains(&name) || taken.contains(&create(&name)) {
            name = match number {
                1 => format!("{wanted}_node"),
                _ => format!("{wanted}_node{number}"),
            };
            number += 1;
        }
        taken.extend([name.clone(), create(&name)]);
        names.push(name);
    }
    names
}

/// The function that creates a node of this name.
fn create(node: &str) -> String {
    format!("create_{node}")
}

/// Names as one, without underscores beside each other: `control` and `type_` are `control_type`.
pub fn joined<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let names = names.into_iter().map(|name| plain(name).trim_matches('_'));
    names.collect::<Vec<_>>().join("_")
}

/// The last name of a path, as it is written.
pub fn last(path: &str) -> &str {
    path.rsplit("::").next().unwrap_or(path)
}

/// A name as people and clients know it, also where Rust writes it raw: `r#type` is `type`.
pub fn plain(name: &str) -> &str {
    name.strip_prefix("r#").unwrap_or(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn instances_become_constants() {
        assert_eq!(constant_case("VisionTop"), "VISION_TOP");
    }

    #[test]
    fn a_name_is_given_once() {
        let mut names = Names::with(["a".to_owned()]);
        assert_eq!(names.give("a"), "a2");
        assert_eq!(names.give("b"), "b");
        assert_eq!(names.give("b"), "b2");
    }
    #[test]
    fn joined_names_have_single_underscores() {
        assert_eq!(joined(["control", "walk"]), "control_walk");
        assert_eq!(joined(["control", "type_", "a"]), "control_type_a");
        assert_eq!(joined(["r#type"]), "type");
    }
}
