//! What was probably meant by a path that leads nowhere.

use framework::parameters::nearest;
use framework::reflect::Path;
use protocol::EntryKind;

use super::{PARAMETERS, tree};
use crate::hub::Hub;

/// The nearest name of the first part that is wrong.
pub(crate) fn near(hub: &Hub, path: &str) -> Option<String> {
    let root = tree(hub);
    let mut place = &root;
    let mut rest = path;
    loop {
        let (name, further) = rest.split_once('.').unwrap_or((rest, ""));
        let mut below = place.below.iter();
        if let Some(inner) = below.find(|inner| inner.name == name) {
            (place, rest) = (inner, further);
            continue;
        }
        // All parts are right: what is there only is no output.
        if name.is_empty() {
            return None;
        }
        let names = place.below.iter().map(|inner| inner.name);
        let near = nearest(name, names)?;
        let above = &path[..path.len() - rest.len()];
        return Some(match further {
            "" => format!("{above}{near}"),
            _ => format!("{above}{near}.{further}"),
        });
    }
}

/// The whole path of what was named without the words before it: `ball`, `Control.ball`, `ball_filter.gate`.
pub(crate) fn shortened(hub: &Hub, path: &str) -> Option<String> {
    let mut outputs = hub.sources.iter().filter_map(|source| {
        let instance = hub.link.instances.get(source.instance)?.description.name;
        let behind = path.strip_prefix(instance);
        let rest = behind
            .and_then(|rest| rest.strip_prefix('.'))
            .unwrap_or(path);
        let below = rest.strip_prefix(source.name())?;
        let is_named = below.is_empty() || below.starts_with('.');
        is_named.then(|| format!("{}{below}", source.path))
    });
    let parameter = || {
        let parsed: Path = path.parse().ok()?;
        let shape = hub.link.parameters.shape();
        let is_there = !path.is_empty() && shape.at(&parsed).is_ok();
        is_there.then(|| format!("{PARAMETERS}.{path}"))
    };
    outputs.next().or_else(parameter)
}

/// The procedure of that name, wherever it is, or else of the nearest name.
pub(super) fn procedure(hub: &Hub, path: &str) -> Option<String> {
    let root = tree(hub);
    let folders = root.below.iter().flat_map(|place| &place.below);
    let all = folders.flat_map(|folder| &folder.below);
    let all: Vec<_> = all
        .filter(|place| place.kind == EntryKind::Procedure)
        .collect();
    let last = path.rsplit('.').next().unwrap_or(path);
    let named = |name: &str| all.iter().find(|place| place.name == name);
    let near = || named(nearest(last, all.iter().map(|place| place.name))?);
    named(last).or_else(near).map(|place| place.path.clone())
}
