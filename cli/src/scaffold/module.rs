//! `mod` lines: where a module is declared, where a new one goes, and how one leaves.

use std::ops::Range;

use camino::{Utf8Path, Utf8PathBuf};
use syn::spanned::Spanned as _;
use syn::{Attribute, Item, ItemMod, Visibility};

use super::{Changes, read};
use crate::outcome::Refusal;
use crate::scan::library::{candidates, path_attribute, places};
use crate::scan::module::{folder_of, only_for_tests};
use crate::scan::range;
use crate::workspace::{Member, Workspace};

/// A file of a crate, and where the files of its modules lie.
struct Place {
    /// As written in `use`.
    path: String,
    file: Utf8PathBuf,
    folder: Utf8PathBuf,
}

impl Place {
    fn root(member: &Member) -> Self {
        Self {
            path: member.library.clone(),
            file: member.root_file.clone(),
            folder: folder_of(&member.root_file, true),
        }
    }
}

/// Declares a new module, its parents included; the module's own file is not among the changes but named.
pub(super) fn declare(
    workspace: &Workspace,
    member: &Member,
    names: &[&str],
) -> Result<(Changes, Utf8PathBuf), Refusal> {
    let mut place = Place::root(member);
    for (index, name) in names.iter().enumerate() {
        let text = read(workspace, &place.file)?;
        let syntax = parse(&place.file, &text)?;
        if let Some(item) = find(&syntax, name) {
            if index + 1 == names.len() {
                let path = format!("{}::{name}", place.path);
                let message = format!("the module `{path}` is there already");
                let help = format!(
                    "choose another name, or write \"{path}\" into a list of nodes in hulk.toml"
                );
                return Err(Refusal::wrong_usage(message).help(help));
            }
            place = child(workspace, &place, item)?;
            continue;
        }
        let mut changes = Changes::new();
        changes.insert(place.file.clone(), Some(with_module(&text, &syntax, name)));
        let file = parents(workspace, place, &names[index..], &mut changes)?;
        return Ok((changes, file));
    }
    Err(Refusal::wrong_usage(
        "a node is a module of a crate, written `crate::module`",
    ))
}

/// The file that declares a module, and its text without that line.
pub(super) fn undeclare(
    workspace: &Workspace,
    member: &Member,
    names: &[&str],
) -> Result<(Utf8PathBuf, String), Refusal> {
    let mut place = Place::root(member);
    for (index, name) in names.iter().enumerate() {
        let text = read(workspace, &place.file)?;
        let syntax = parse(&place.file, &text)?;
        let Some(item) = find(&syntax, name) else {
            break;
        };
        if index + 1 < names.len() {
            place = child(workspace, &place, item)?;
        } else if item.content.is_none() {
            return Ok((place.file, without(&text, range(item.span()))));
        }
    }
    let path = names.join("::");
    Err(Refusal::bad(format!(
        "`{}::{path}` has no file of its own that could be deleted",
        member.library
    )))
}

/// Whether a file has modules in files of their own.
pub(super) fn has_modules(text: &str) -> bool {
    syn::parse_file(text).is_ok_and(|syntax| {
        syntax
            .items
            .iter()
            .any(|item| matches!(item, Item::Mod(item) if item.content.is_none()))
    })
}

/// Files for the modules between, each with the line that declares the next; answers with the last module's file.
fn parents(
    workspace: &Workspace,
    mut place: Place,
    names: &[&str],
    changes: &mut Changes,
) -> Result<Utf8PathBuf, Refusal> {
    let modern = !keeps_mod_files(workspace, &place.folder);
    for (index, name) in names.iter().enumerate() {
        if let Some(file) = candidates(&place.folder, name)
            .into_iter()
            .find(|file| workspace.is_file(file))
        {
            let message = format!("`{file}` is there already, but nobody declares its module");
            return Err(Refusal::wrong_usage(message)
                .help("choose another name, or declare it and write it into hulk.toml"));
        }
        let Some(next) = names.get(index + 1) else {
            return Ok(place.folder.join(format!("{name}.rs")));
        };
        let file = if modern {
            place.folder.join(format!("{name}.rs"))
        } else {
            place.folder.join(name).join("mod.rs")
        };
        let text = format!(
            "//! Nodes about {}.\n\npub mod {next};\n",
            name.replace('_', " ")
        );
        changes.insert(file.clone(), Some(text));
        place = Place {
            path: format!("{}::{name}", place.path),
            folder: place.folder.join(name),
            file,
        };
    }
    Ok(place.file)
}

/// The crate writes `foo/mod.rs`.
fn keeps_mod_files(workspace: &Workspace, folder: &Utf8Path) -> bool {
    let inside = workspace.list(folder);
    inside
        .iter()
        .any(|entry| workspace.is_file(&entry.join("mod.rs")))
}

fn child(workspace: &Workspace, parent: &Place, item: &ItemMod) -> Result<Place, Refusal> {
    let name = item.ident.to_string();
    let path = format!("{}::{name}", parent.path);
    if item.content.is_some() {
        let message = format!("`{path}` stands inside of `{}`", parent.file);
        return Err(Refusal::bad(message).help("give it a file of its own first"));
    }
    let base = parent.file.parent().unwrap_or(Utf8Path::new(""));
    let files = places(base, &parent.folder, item);
    let found = files.iter().find(|file| workspace.is_file(file));
    let file =
        found.ok_or_else(|| Refusal::bad(format!("the file of module `{path}` does not exist")))?;
    Ok(Place {
        path,
        folder: folder_of(file, path_attribute(item).is_some()),
        file: file.clone(),
    })
}

fn parse(file: &Utf8Path, text: &str) -> Result<syn::File, Refusal> {
    syn::parse_file(text)
        .map_err(|error| Refusal::bad(format!("`{file}` cannot be parsed: {error}")))
}

fn find<'s>(syntax: &'s syn::File, name: &str) -> Option<&'s ItemMod> {
    modules(syntax).find(|item| item.ident == name)
}

fn modules(syntax: &syn::File) -> impl Iterator<Item = &ItemMod> {
    let modules = syntax.items.iter().filter_map(|item| match item {
        Item::Mod(item) => Some(item),
        _ => None,
    });
    modules.filter(|item| !only_for_tests(&item.attrs))
}

/// The text with one more `pub mod` line: sorted in where the others are sorted, else behind the last.
fn with_module(text: &str, syntax: &syn::File, name: &str) -> String {
    let end = if text.contains("\r\n") { "\r\n" } else { "\n" };
    let is_public = |item: &&ItemMod| matches!(item.vis, Visibility::Public(_));
    let in_files = || modules(syntax).filter(|item| item.content.is_none());
    let mut lines: Vec<&ItemMod> = in_files().filter(is_public).collect();
    if lines.is_empty() {
        lines = in_files().collect();
    }
    let line = format!("pub mod {name};{end}");
    let Some(first) = lines.first() else {
        return at_head(text, syntax, &line, end);
    };
    let sorted = lines.is_sorted_by_key(|item| item.ident.to_string());
    let before = |item: &&&ItemMod| !sorted || item.ident.to_string().as_str() < name;
    let at = match lines.iter().rfind(before) {
        Some(item) => end_of_line(text, range(item.span()).end),
        None => range(first.span()).start,
    };
    let (above, below) = text.split_at(at);
    let missing = if above.is_empty() || above.ends_with('\n') {
        ""
    } else {
        end
    };
    format!("{above}{missing}{line}{below}")
}

/// Below the documentation of a file without modules.
fn at_head(text: &str, syntax: &syn::File, line: &str, end: &str) -> String {
    let inner = syntax
        .attrs
        .iter()
        .map(|attribute: &Attribute| range(attribute.span()).end);
    let Some(head) = inner.max() else {
        let gap = if text.trim().is_empty() { "" } else { end };
        return format!("{line}{gap}{text}");
    };
    let (above, below) = text.split_at(end_of_line(text, head));
    let missing = if above.ends_with('\n') { "" } else { end };
    let gap = if below.trim().is_empty() || below.starts_with(end) {
        ""
    } else {
        end
    };
    format!("{above}{missing}{end}{line}{gap}{below}")
}

/// The text without the lines of a range, or without the range alone where something else stands on its lines; an empty
/// line that would stand twice goes, too.
fn without(text: &str, range: Range<usize>) -> String {
    let start = text[..range.start]
        .rfind('\n')
        .map_or(0, |newline| newline + 1);
    let (above, below) = (&text[..start], &text[end_of_line(text, range.end)..]);
    let before = &text[start..range.start];
    let behind = text[range.end..text.len() - below.len()].trim();
    if !before.trim().is_empty() {
        return format!("{above}{}{}", before.trim_end(), &text[range.end..]);
    }
    if !behind.is_empty() && !behind.starts_with("//") {
        return format!("{above}{before}{}", text[range.end..].trim_start());
    }
    let is_gap = above.is_empty() || above.ends_with("\n\n") || above.ends_with("\n\r\n");
    let below = match below.strip_prefix('\n').or(below.strip_prefix("\r\n")) {
        Some(rest) if is_gap => rest,
        _ => below,
    };
    let text = format!("{above}{below}");
    if below.is_empty() && is_gap {
        return format!("{}\n", text.trim_end())
            .trim_start_matches('\n')
            .to_owned();
    }
    text
}

fn end_of_line(text: &str, from: usize) -> usize {
    text[from..]
        .find('\n')
        .map_or(text.len(), |newline| from + newline + 1)
}

#[cfg(test)]
mod tests;
