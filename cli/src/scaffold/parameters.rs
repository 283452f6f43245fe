//! Values of parameter files that nobody reads any more.

use std::collections::BTreeMap;

use camino::Utf8PathBuf;
use toml_edit::{Document, DocumentMut, Item, Table, TableLike};

use super::{Changes, document, read};
use crate::diagnostics::{Code, Diagnostics};
use crate::outcome::Refusal;
use crate::workspace::Workspace;

/// Parameter files without every value that is an `unknown-parameter` by now.
pub fn without_unread(workspace: &Workspace, found: &Diagnostics) -> Result<Changes, Refusal> {
    let mut places: BTreeMap<Utf8PathBuf, Vec<usize>> = BTreeMap::new();
    for diagnostic in found.sorted() {
        if let (Code::UnknownParameter, Some(label)) = (diagnostic.code, diagnostic.spans.first()) {
            places
                .entry(label.file.clone())
                .or_default()
                .push(label.range.start);
        }
    }
    let mut changes = Changes::new();
    for (file, starts) in places {
        let text = read(workspace, &file)?;
        let spanned = Document::parse(&*text)
            .map_err(|error| Refusal::bad(format!("`{file}`: {}", error.message())))?;
        let mut edited = document::parse(&file, &text)?;
        for start in starts {
            let mut path = Vec::new();
            if find(spanned.as_table(), start, &mut path) {
                remove(&mut edited, &path);
            }
        }
        changes.insert(file, Some(document::written(&edited, &text)));
    }
    Ok(changes)
}

/// The keys that lead to the key at a place.
fn find(table: &dyn TableLike, start: usize, path: &mut Vec<String>) -> bool {
    for (name, item) in table.iter() {
        path.push(name.to_owned());
        let key = table.key(name).and_then(|key| key.span());
        let is_here = key.is_some_and(|span| span.start == start);
        if is_here
            || item
                .as_table_like()
                .is_some_and(|inner| find(inner, start, path))
        {
            return true;
        }
        path.pop();
    }
    false
}

/// Removes the value at a path with the tables that have nothing else; a heading above them stays.
fn remove(document: &mut DocumentMut, path: &[String]) {
    let mut depth = path.len();
    while depth > 1 && table_at(document, &path[..depth - 1]).is_some_and(|table| table.len() == 1)
    {
        depth -= 1;
    }
    let Some((name, above)) = path[..depth].split_last() else {
        return;
    };
    let removed = table_at(document, above).and_then(|table| table.remove(name));
    if let Some(Item::Table(table)) = removed
        && let Some(heading) = heading(comments_above(&table))
        && heading.contains('#')
    {
        keep(document, table.position(), heading);
    }
}

/// What stands above the last empty line.
fn heading(comments: &str) -> Option<&str> {
    let ends = ["\n\n", "\r\n\r\n"].map(|empty| comments.rfind(empty));
    ends.into_iter().flatten().max().map(|end| &comments[..end])
}

fn table_at<'d>(document: &'d mut DocumentMut, path: &[String]) -> Option<&'d mut dyn TableLike> {
    let mut table: &mut dyn TableLike = document.as_table_mut();
    for name in path {
        table = table.get_mut(name)?.as_table_like_mut()?;
    }
    Some(table)
}

/// Puts comments above the first table behind a position.
fn keep(document: &mut DocumentMut, behind: Option<isize>, comments: &str) {
    match next_table(document.as_table_mut(), behind) {
        Some(table) => {
            let own = comments_above(table).trim_start_matches('\n').to_owned();
            table.decor_mut().set_prefix(format!("{comments}\n\n{own}"));
        }
        None => {
            let end = document.trailing().as_str().unwrap_or_default();
            document.set_trailing(format!("{comments}\n{end}"));
        }
    }
}

fn next_table(table: &mut Table, behind: Option<isize>) -> Option<&mut Table> {
    let tables = table.iter_mut().filter_map(|(_, item)| item.as_table_mut());
    let all = tables.flat_map(|table| {
        let own = !table.is_implicit() && table.position() > behind;
        match own {
            true => Some(table),
            false => next_table(table, behind),
        }
    });
    all.min_by_key(|table| table.position())
}

fn comments_above(table: &Table) -> &str {
    let prefix = table.decor().prefix();
    prefix.and_then(|text| text.as_str()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::{document, remove};

    #[test]
    fn headings_and_comments_at_the_end_stay() {
        for (end, expected) in [
            ("", "# Heading.\n"),
            ("\n# The end.\n", "# Heading.\n\n# The end.\n"),
        ] {
            let text = format!("# Heading.\n\n# About a.\n[a]\nx = 1\n{end}");
            let mut parsed = document::parse("a.toml".into(), &text).expect("it is TOML");
            remove(&mut parsed, &["a".to_owned(), "x".to_owned()]);
            assert_eq!(parsed.to_string(), expected);
        }
    }

    #[test]
    fn headings_stay_whatever_ends_the_lines() {
        let text = "# Heading.\n\n# About a.\n[a]\nx = 1\n".replace('\n', "\r\n");
        let mut parsed = document::parse("a.toml".into(), &text).expect("it is TOML");
        remove(&mut parsed, &["a".to_owned(), "x".to_owned()]);
        let left = document::written(&parsed, &text);
        assert_eq!(left, "# Heading.\r\n");
    }
}
