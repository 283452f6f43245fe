//! Names in generated code: the only place where casing happens.

use std::collections::BTreeSet;

use crate::resolve::robot::Node;

/// Names that every file of nodes defines itself.
const FUNCTIONS_OF_NODES: [&str; 6] = ["create", "cycle", "inject", "new", "restore", "setup"];

/// `VisionTop` becomes `vision_top`, `SPLMessage` `spl_message`.
pub fn snake_case(name: &str) -> String {
    let letters: Vec<char> = name.chars().collect();
    let mut snake = String::new();
    for (position, letter) in letters.iter().enumerate() {
        let before = position.checked_sub(1).map(|before| letters[before]);
        let after = letters.get(position + 1);
        let starts_word = letter.is_uppercase()
            && before.is_some_and(|before| {
                before.is_lowercase()
                    || before.is_numeric()
                    || before.is_uppercase() && after.is_some_and(|after| after.is_lowercase())
            });
        if starts_word {
            snake.push('_');
        }
        snake.extend(letter.to_lowercase());
    }
    snake
}

/// `field_dimensions` becomes `FieldDimensions`.
pub fn upper_camel_case(name: &str) -> String {
    name.split('_')
        .flat_map(|word| {
            let mut letters = word.chars();
            letters
                .next()
                .into_iter()
                .flat_map(char::to_uppercase)
                .chain(letters)
        })
        .collect()
}

/// `VisionTop` becomes `VISION_TOP`.
pub fn constant_case(name: &str) -> String {
    snake_case(name).to_uppercase()
}

/// Names given so far in one place; no name is given twice.
#[derive(Clone, Debug, Default)]
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
        let mut name = wanted.to_owned();
        let mut number = 2;
        while !self.given.insert(name.clone()) {
            name = format!("{wanted}{number}");
            number += 1;
        }
        name
    }
}

/// What the nodes of one cycler are called there: the last name of their path, or the whole path
/// where another node ends in the same name.
pub fn name_nodes(nodes: &[Node]) -> Vec<String> {
    let short = |node: &Node| last(&node.path).to_owned();
    let mut names = Names::with(FUNCTIONS_OF_NODES.map(str::to_owned));
    let shorts: Vec<String> = nodes.iter().map(short).collect();
    let wanted: Vec<String> = nodes
        .iter()
        .zip(&shorts)
        .map(|(node, short)| {
            let unique = shorts.iter().filter(|other| *other == short).count() == 1;
            if unique {
                short.clone()
            } else {
                node.path.replace("r#", "").replace("::", "_")
            }
        })
        .collect();
    let created: BTreeSet<String> = wanted.iter().map(|name| format!("create_{name}")).collect();
    wanted
        .iter()
        .map(|name| {
            let taken = FUNCTIONS_OF_NODES.contains(&name.as_str()) || created.contains(name);
            names.give(&if taken {
                format!("{name}_node")
            } else {
                name.clone()
            })
        })
        .collect()
}

/// The last name of a path.
pub fn last(path: &str) -> &str {
    plain(path.rsplit("::").next().unwrap_or(path))
}

/// A name as people and clients know it, also where Rust writes it raw: `r#type` is `type`.
pub fn plain(name: &str) -> &str {
    name.strip_prefix("r#").unwrap_or(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn instances_become_fields() {
        let cases = [
            ("VisionTop", "vision_top"),
            ("Control", "control"),
            ("SPLNetwork", "spl_network"),
            ("Vision2Top", "vision2_top"),
            ("already_snake", "already_snake"),
        ];
        for (name, expected) in cases {
            assert_eq!(snake_case(name), expected);
        }
    }

    #[test]
    fn fields_become_types() {
        assert_eq!(upper_camel_case("field_dimensions"), "FieldDimensions");
        assert_eq!(upper_camel_case("vision_top"), "VisionTop");
        assert_eq!(constant_case("VisionTop"), "VISION_TOP");
    }

    #[test]
    fn a_name_is_given_once() {
        let mut names = Names::with(["a".to_owned()]);
        assert_eq!(names.give("a"), "a2");
        assert_eq!(names.give("b"), "b");
        assert_eq!(names.give("b"), "b2");
    }
}
