//! Which of several values a robot gets, by where it is and who it is.

use camino::Utf8PathBuf;
use serde::Serialize;

use super::given::{Given, Identity, Value};

/// Robots that get the same value.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Winner {
    /// None: everywhere that no other winner names.
    pub location: Option<String>,
    /// An identity that is not among them is one that no file names.
    pub identities: Vec<Identity>,
    pub file: Utf8PathBuf,
    pub line: usize,
    pub value: String,
}

impl Value {
    /// One for each combination of locations and identities that some file names, and for all others.
    ///
    /// A combination for which no file has a value is left out.
    pub fn winners(&self) -> Vec<Winner> {
        let mut locations = vec![None];
        for given in &self.given {
            if !locations.contains(&given.robots.location) {
                locations.push(given.robots.location.clone());
            }
        }
        let identities = self.identities();
        let combinations = locations
            .iter()
            .flat_map(|location| identities.iter().map(move |ids| (location, ids)));
        combinations
            .filter_map(|(location, identities)| {
                let applies = |given: &&Given| {
                    let robots = &given.robots;
                    let is_here = robots.location.is_none() || robots.location == *location;
                    is_here && robots.identity.iter().all(|one| identities.contains(one))
                };
                let given = self.given.iter().rfind(applies)?;
                Some(Winner {
                    location: location.clone(),
                    identities: identities.clone(),
                    file: given.file.clone(),
                    line: given.line,
                    value: given.value.clone(),
                })
            })
            .collect()
    }

    /// Every combination of named identities, at most one of each name; the first is nobody.
    fn identities(&self) -> Vec<Vec<Identity>> {
        let mut named: Vec<(&str, Vec<&Identity>)> = Vec::new();
        for identity in self
            .given
            .iter()
            .filter_map(|it| it.robots.identity.as_ref())
        {
            match named.iter_mut().find(|(name, _)| *name == identity.name) {
                Some((_, ids)) if ids.contains(&identity) => {}
                Some((_, ids)) => ids.push(identity),
                None => named.push((&identity.name, vec![identity])),
            }
        }
        named
            .iter()
            .fold(vec![Vec::new()], |combinations, (_, ids)| {
                let with = |one: &Vec<Identity>| {
                    let choices = std::iter::once(None).chain(ids.iter().map(Some));
                    let choices =
                        choices.map(|id| one.iter().chain(id.copied()).cloned().collect());
                    choices.collect::<Vec<_>>()
                };
                combinations.iter().flat_map(with).collect()
            })
    }
}
