//! Structs that mirror trees of declared paths: parameters, cycler states, additional outputs.

use std::collections::BTreeMap;

use serde::Serialize;

use super::names::{Names, PRELUDE, upper_camel_case};
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

/// Structs of a tree: the root first, then the levels below in the order of their fields.
pub struct Structs<'a, U> {
    robot: &'a Robot,
    /// In front of the names of all structs but the root's.
    prefix: &'a str,
    docs: &'a dyn Fn(&[U]) -> String,
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
            names: Names::with(PRELUDE.into_iter().chain(DERIVED).map(str::to_owned)),
            instances: BTreeMap::new(),
        }
    }

    /// The structs of this tree, whose root has this name.
    pub fn describe(&mut self, root: &str, tree: &Tree<U>) -> Vec<Struct> {
        let name = self.names.give(root);
        self.level(name, "", tree)
    }

    fn level(&mut self, name: String, path: &str, tree: &Tree<U>) -> Vec<Struct> {
        let mut fields = Vec::new();
        let mut below = Vec::new();
        for branch in &tree.branches {
            let mut docs = String::new();
            let content = match &branch.content {
                Content::Leaf { data, users } => {
                    docs = (self.docs)(users);
                    FieldType::Data(data.text.clone())
                }
                Content::Inner(tree) => {
                    let path = format!("{path}{}", upper_camel_case(&branch.name));
                    let name = self.names.give(&format!("{}{path}", self.prefix));
                    below.extend(self.level(name.clone(), &path, tree));
                    FieldType::Struct(name)
                }
                Content::Instance { cycler, tree } => {
                    let (name, structs) = self.instance(path, *cycler, tree);
                    below.extend(structs);
                    FieldType::Struct(name)
                }
            };
            fields.push(StructField {
                name: branch.name.clone(),
                docs,
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

    /// The struct of one instance: the one of the instance before if both look alike.
    fn instance(&mut self, path: &str, cycler: usize, tree: &Tree<U>) -> (String, Vec<Struct>) {
        let path = format!("{path}{}Instance", self.robot.cyclers[cycler].name);
        let before = self.names.clone();
        let name = self.names.give(&format!("{}{path}", self.prefix));
        let structs = self.level(name.clone(), &path, tree);
        let known = self.instances.entry((path, cycler)).or_default();
        if let Some(known) = known.iter().find(|known| same_fields(known, &structs[0])) {
            self.names = before;
            return (known.name.clone(), Vec::new());
        }
        known.push(structs[0].clone());
        (name, structs)
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
