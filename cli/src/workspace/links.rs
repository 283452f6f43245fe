//! Links of a git revision, followed within it.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

use camino::{Utf8Component, Utf8Path, Utf8PathBuf};

use super::members::{normalized, relative};

/// As many as Linux follows on the way to one file.
const MOST: usize = 40;

/// Every link of a repository, seen from a folder in it.
#[derive(Clone, Debug, Default)]
pub(super) struct Links {
    /// The folder, from the repository's root.
    prefix: Utf8PathBuf,
    /// Where each leads to, as it is written; from the repository's root.
    targets: BTreeMap<Utf8PathBuf, Utf8PathBuf>,
    /// Links that somebody asked for in vain.
    broken: RefCell<BTreeSet<BrokenLink>>,
}

/// A link that leads to no file of the repository. Its path is relative to the workspace root.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, thiserror::Error)]
#[error("`{link}` is a link to `{target}`, {leads}")]
pub struct BrokenLink {
    pub link: Utf8PathBuf,
    pub target: Utf8PathBuf,
    leads: &'static str,
}

impl Links {
    pub(super) fn new(prefix: &Utf8Path, targets: BTreeMap<Utf8PathBuf, Utf8PathBuf>) -> Self {
        Self {
            prefix: prefix.to_owned(),
            targets,
            broken: RefCell::default(),
        }
    }

    /// Where a path leads to if every link on the way is followed; both relative to the workspace root.
    pub(super) fn follow(&self, path: &Utf8Path) -> Option<Utf8PathBuf> {
        if self.targets.is_empty() {
            return Some(path.to_owned());
        }
        let real = self.real(&self.in_repository(path)).ok()?;
        let real = relative(&self.prefix, &real);
        Some(match real.as_str() {
            "." => Utf8PathBuf::new(),
            _ => real,
        })
    }

    pub(super) fn is_link(&self, path: &Utf8Path) -> bool {
        self.targets.contains_key(&self.in_repository(path))
    }

    /// Names of the links directly in a folder whose links were followed.
    pub(super) fn names_in(&self, folder: &Utf8Path) -> impl Iterator<Item = &str> {
        let folder = self.in_repository(folder);
        let links = self.targets.keys();
        let links = links.filter(move |link| link.parent() == Some(&folder));
        links.filter_map(|link| link.file_name())
    }

    /// Somebody asks for a path behind which there is no file; `has`: whether there is something in a folder.
    pub(super) fn note_missing(&self, path: &Utf8Path, has: impl Fn(&Utf8Path) -> bool) {
        let path = self.in_repository(path);
        // Without a link on the way nothing is missing that was ever there.
        let mut ways = path.ancestors();
        let Some(link) = ways.find(|way| self.targets.contains_key(*way)) else {
            return;
        };
        let leads = match self.real(link) {
            Err(leads) => leads,
            // It is a folder, which may lack a file.
            Ok(_)
                if self
                    .follow(&relative(&self.prefix, link))
                    .is_some_and(|real| has(&real)) =>
            {
                return;
            }
            Ok(_) => "which the revision does not have",
        };
        let broken = BrokenLink {
            link: relative(&self.prefix, link),
            target: self.targets[link].clone(),
            leads,
        };
        self.broken.borrow_mut().insert(broken);
    }

    pub(super) fn broken(&self) -> Option<BrokenLink> {
        self.broken.borrow().first().cloned()
    }

    fn in_repository(&self, path: &Utf8Path) -> Utf8PathBuf {
        normalized(&self.prefix.join(path))
    }

    /// The path without links, from the repository's root, or where it leads instead.
    fn real(&self, path: &Utf8Path) -> Result<Utf8PathBuf, &'static str> {
        const OUT: &str = "which leads out of the repository";
        let mut rest: Vec<String> = parts(path).rev().collect();
        let mut real = Utf8PathBuf::new();
        let mut followed = 0;
        while let Some(part) = rest.pop() {
            match part.as_str() {
                "." => {}
                ".." => {
                    if !real.pop() {
                        return Err(OUT);
                    }
                }
                _ => real.push(part),
            }
            let Some(target) = self.targets.get(&real) else {
                continue;
            };
            followed += 1;
            if followed > MOST {
                return Err("which leads in a circle");
            }
            if target.is_absolute() {
                return Err(OUT);
            }
            real.pop();
            rest.extend(parts(target).rev());
        }
        Ok(real)
    }
}

fn parts(path: &Utf8Path) -> impl DoubleEndedIterator<Item = String> {
    let parts = path.components();
    parts.map(|part: Utf8Component<'_>| part.as_str().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn links(targets: &[(&str, &str)]) -> Links {
        let targets = targets.iter();
        let targets = targets.map(|(link, target)| ((*link).into(), (*target).into()));
        Links::new("robots/nao".into(), targets.collect())
    }

    #[test]
    fn links_lead_where_the_disk_would_lead() {
        let links = links(&[
            ("robots/nao/own.toml", "../../shared/own.toml"),
            ("robots/nao/parameters", "../common"),
            ("robots/common", "../shared/./parameters"),
            ("shared/parameters/head.toml", "../../robots/nao/head.toml"),
        ]);
        let follow = |path: &str| links.follow(path.into()).map(Utf8PathBuf::into_string);
        for (path, real) in [
            ("own.toml", "../../shared/own.toml"),
            ("parameters", "../../shared/parameters"),
            ("parameters/a.toml", "../../shared/parameters/a.toml"),
            ("parameters/head.toml", "head.toml"),
            ("../nao/plain.rs", "plain.rs"),
            ("", ""),
        ] {
            assert_eq!(follow(path).as_deref(), Some(real), "{path}");
        }
        assert!(links.is_link("own.toml".into()) && !links.is_link("head.toml".into()));
        let names: Vec<_> = links.names_in("".into()).collect();
        assert_eq!(names, ["own.toml", "parameters"]);
    }

    #[test]
    fn a_link_to_a_folder_leads_somewhere() {
        let links = links(&[("robots/nao/parameters/lab", "../../shared/lab")]);
        let has = |folder: &Utf8Path| folder == "../shared/lab";
        links.note_missing("parameters/lab".into(), has);
        links.note_missing("parameters/lab/other.toml".into(), has);
        assert_eq!(links.broken(), None);
        links.note_missing("parameters/lab".into(), |_| false);
        assert!(links.broken().is_some());
    }

    #[test]
    fn what_leads_nowhere_is_named_if_somebody_asks_for_it() {
        for (target, leads) in [
            ("/etc/own.toml", "which leads out of the repository"),
            ("../../../own.toml", "which leads out of the repository"),
            ("own.toml", "which leads in a circle"),
            ("gone.toml", "which the revision does not have"),
        ] {
            let links = links(&[("robots/nao/own.toml", target)]);
            links.note_missing("other.toml".into(), |_| false);
            assert_eq!(links.broken(), None);
            links.note_missing("own.toml".into(), |_| false);
            let broken = links.broken().expect("it was asked for").to_string();
            assert_eq!(
                broken,
                format!("`own.toml` is a link to `{target}`, {leads}")
            );
        }
    }
}
