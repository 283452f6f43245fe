//! `src/parameters.rs`: the parameter tree as structs.

use serde::Serialize;

use super::sentences;
use super::structs::{FieldType, Struct, Structs};
use crate::resolve::robot::{Reader, Robot};

/// The parameter tree of a robot.
#[derive(Clone, Debug, Serialize)]
pub struct Parameters {
    /// The root first, then the levels below.
    pub structs: Vec<Struct>,
}

/// Decides the structs of the parameter tree.
pub fn describe(robot: &Robot) -> Parameters {
    let docs =
        |readers: &[Reader]| sentences::list(readers.iter().map(|reader| reader.node.as_str()));
    let mut structs = Structs::new(robot, "", &docs).hinted(&robot.parameter_hints);
    let structs = structs.describe("Parameters", &robot.parameter_tree);
    Parameters { structs }
}

impl Parameters {
    /// What stands at a path of the tree.
    pub fn content<'a>(&self, path: impl IntoIterator<Item = &'a String>) -> Option<FieldType> {
        let mut content = FieldType::Struct(self.structs.first()?.name.clone());
        for name in path {
            let FieldType::Struct(level) = content else {
                return None;
            };
            let level = self.structs.iter().find(|known| known.name == level)?;
            content = level
                .fields
                .iter()
                .find(|field| field.name == *name)?
                .content
                .clone();
        }
        Some(content)
    }
}
