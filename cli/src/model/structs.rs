//! Structs that mirror trees of declared paths: parameters, cycler states, additional outputs.

use std::collections::BTreeMap;

use serde::Serialize;

use super::names::{Names, PRELUDE, upper_camel_case};
pub use crate::resolve::robot::Hints;
use crate::resolve::robot::{Content, Robot, Tree};

/// Traits that are derived for the structs and are not the prelude's.
const DERIVED: [&str; 3] = ["Deserialize", "Reflect", "Serialize"];

/// A struct of one level of a tree.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Struct {
    pub name: String,
    pub fields: Vec<StructField>,
    /// Values that are no fields may stand beside those that are.
    pub open: bool,
}

/// A name at one level of a tree.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct StructField {
    pub name: String,
    /// Its doc comment, empty if it has none: who uses it.
    pub docs: String,
    /// What clients are told about it; nothing in other trees than that of the parameters.
    pub hints: Hints,
    pub content: FieldType,
}

/// What a field of the tree is.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub enum FieldType {
    /// A declared value: its absolute type.
    Data(String),
    /// The struct of the level below.
    Struct(String),
}

/// Where a level lies.
#[derive(Default)]
struct Place {
    /// What names of types begin with.
    types: String,
    /// As parameter files write it.
    path: String,
}

/// Structs of a tree: the root first, then the levels below in the order of their fields.
pub struct Structs<'a, U> {
    robot: &'a Robot,
    /// In front of the names of all structs but the root's.
    prefix: &'a str,
    docs: &'a dyn Fn(&[U]) -> String,
    hints: Option<&'a BTreeMap<String, Hints>>,
    names: Names,
    /// What the instances of a cycler look like at a place of the tree, and the struct's name.
    instances: BTreeMap<(String, usize), Vec<Struct>>,
}

impl<'a, U> Structs<'a, U> {
    /// `docs` makes the doc comment of a declared value from those who use it.
    pub fn new(robot: &'a Robot, prefix: &'a str, docs: &'a dyn Fn(&[U]) -> String) -> Self {
        Self {
            robot,
            prefix,
            docs,
            hints: None,
            names: Names::with(PRELUDE.into_iter().chain(DERIVED).map(str::to_owned)),
            instances: BTreeMap::new(),
        }
    }

    /// With what is known of declared values, by path.
    #[must_use]
    pub fn hinted(mut self, hints: &'a BTreeMap<String, Hints>) -> Self {
        self.hints = Some(hints);
        self
    }

    /// The structs of this tree, whose root has this name.
    pub fn describe(&mut self, root: &str, tree: &Tree<U>) -> Vec<Struct> {
        let name = self.names.give(root);
        self.level(name, &Place::default(), tree)
    }

    fn level(&mut self, name: String, place: &Place, tree: &Tree<U>) -> Vec<Struct> {
        let mut fields = Vec::new();
        let mut below = Vec::new();
        for branch in &tree.branches {
            let written = place.written(&branch.name);
            let mut docs = String::new();
            let content = match &branch.content {
                Content::Leaf { data, users } => {
                    docs = (self.docs)(users);
                    FieldType::Data(data.text.clone())
                }
                Content::Inner(tree) => {
                    let types = self.types(place, &branch.name);
                    let name = self.names.give(&format!("{}{types}", self.prefix));
                    let place = Place {
                        types,
                        path: written.clone(),
                    };
                    below.extend(self.level(name.clone(), &place, tree));
                    FieldType::Struct(name)
                }
                Content::Instance { cycler, tree } => {
                    let types = format!(
                        "{}{}Instance",
                        place.types, self.robot.cyclers[*cycler].name
                    );
                    let place = Place {
                        types,
                        path: written.clone(),
                    };
                    let (name, structs) = self.instance(place, *cycler, tree);
                    below.extend(structs);
                    FieldType::Struct(name)
                }
            };
            fields.push(StructField {
                name: branch.name.clone(),
                docs,
                hints: self
                    .hints
                    .and_then(|hints| hints.get(&written))
                    .cloned()
                    .unwrap_or_default(),
                content,
            });
        }
        let mut structs = vec![Struct {
            name,
            fields,
            open: tree.open,
        }];
        structs.append(&mut below);
        structs
    }

    /// What the structs below a place are called; a name begins with a letter also where that of the place does not.
    fn types(&self, place: &Place, name: &str) -> String {
        let types = format!("{}{}", place.types, upper_camel_case(name));
        let is_name = !self.prefix.is_empty() || types.starts_with(char::is_alphabetic);
        match is_name {
            true => types,
            false => format!("Group{types}"),
        }
    }

    /// The struct of one instance: the one of the instance before if both look alike.
    fn instance(&mut self, place: Place, cycler: usize, tree: &Tree<U>) -> (String, Vec<Struct>) {
        let before = self.names.clone();
        let name = self.names.give(&format!("{}{}", self.prefix, place.types));
        let structs = self.level(name.clone(), &place, tree);
        let known = self.instances.entry((place.types, cycler)).or_default();
        if let Some(known) = known.iter().find(|known| same_fields(known, &structs[0])) {
            self.names = before;
            return (known.name.clone(), Vec::new());
        }
        known.push(structs[0].clone());
        (name, structs)
    }
}

impl Place {
    fn written(&self, name: &str) -> String {
        match self.path.as_str() {
            "" => name.to_owned(),
            path => format!("{path}.{name}"),
        }
    }
}

/// Whether two levels take the same values; docs, and names of structs below, aside.
fn same_fields(left: &Struct, right: &Struct) -> bool {
    let shape = |one: &StructField| match &one.content {
        FieldType::Data(data) => (one.name.clone(), Some(data.clone())),
        FieldType::Struct(_) => (one.name.clone(), None),
    };
    let fields = left.fields.iter().map(shape);
    left.open == right.open && fields.eq(right.fields.iter().map(shape))
}
