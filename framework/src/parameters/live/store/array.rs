//! Arrays, of which every element keeps its lines.

use toml_edit::{Array, Value as Written};

use super::layout::{self, Untold};
use crate::parameters::tree::Tree;

/// What stands around the elements, by whom it belongs to.
struct Laid {
    /// Behind the bracket, in its line.
    head: String,
    items: Vec<Element>,
    /// In front of the closing bracket, from the end of the last element's line on.
    end: String,
}

struct Element {
    /// From the end of the line before on: its own comments, and how far it is from the left.
    before: String,
    value: Written,
    /// In front of the comma.
    inside: String,
    /// Behind the comma, in its line.
    behind: String,
}

/// By index: surplus elements go with their comments, new ones are laid out as the last.
pub(super) fn rewrite(known: &mut Array, items: &[Tree]) -> Result<(), Untold> {
    let was_empty = known.is_empty();
    let mut laid = Laid::of(known);
    laid.items.truncate(items.len());
    for (element, item) in laid.items.iter_mut().zip(items) {
        layout::rewrite(&mut element.value, item)?;
    }
    for item in items.iter().skip(laid.items.len()) {
        let new = laid.like_the_last(item)?;
        laid.items.push(new);
    }
    if was_empty && laid.end.contains('\n') {
        known.set_trailing_comma(true);
    }
    laid.put(known);
    Ok(())
}

impl Laid {
    fn of(array: &Array) -> Self {
        let mut gap = String::new();
        let mut head = String::new();
        let mut items: Vec<Element> = Vec::new();
        for value in array.iter() {
            let mut value = value.clone();
            gap.push_str(text(value.decor().prefix()));
            let (own, before) = split(&gap);
            match items.last_mut() {
                Some(last) => last.behind = own,
                None => head = own,
            }
            gap.clear();
            let inside = text(value.decor().suffix()).to_owned();
            value.decor_mut().clear();
            items.push(Element {
                before,
                value,
                inside,
                behind: String::new(),
            });
        }
        // Without a comma, what follows the last element is not inside.
        if let Some(last) = items.last_mut()
            && !array.trailing_comma()
        {
            gap = std::mem::take(&mut last.inside);
        }
        gap.push_str(text(Some(array.trailing())));
        let (own, end) = split(&gap);
        match items.last_mut() {
            Some(last) => last.behind = own,
            None => head = own,
        }
        Self { head, items, end }
    }

    /// The layout of the last element, without its comments.
    fn like_the_last(&self, item: &Tree) -> Result<Element, Untold> {
        let Some(last) = self.items.last() else {
            return Ok(Element {
                before: match self.end.contains('\n') {
                    true => format!("{}    ", last_line(&self.end)),
                    false => String::new(),
                },
                value: layout::to_toml(item)?,
                inside: String::new(),
                behind: String::new(),
            });
        };
        let before = match last.before.contains('\n') {
            true => last_line(&last.before),
            false if last.behind.contains('#') => format!("{}    ", last_line(&self.end)),
            false => " ".to_owned(),
        };
        let mut value = last.value.clone();
        match value.to_string().contains('#') {
            true => value = layout::to_toml(item)?,
            false => layout::rewrite(&mut value, item)?,
        }
        Ok(Element {
            before,
            value,
            inside: String::new(),
            behind: String::new(),
        })
    }

    fn put(self, array: &mut Array) {
        array.clear();
        let mut gap = self.head;
        for element in self.items {
            let Element {
                before,
                mut value,
                inside,
                behind,
            } = element;
            value.decor_mut().set_prefix(gap + &before);
            value.decor_mut().set_suffix(inside);
            array.push_formatted(value);
            gap = behind;
        }
        // The line that ended the comment may have gone with its element.
        if gap.contains('#') && !self.end.contains('\n') {
            gap.push('\n');
            gap.push_str(self.end.trim_start());
        } else {
            gap.push_str(&self.end);
        }
        array.set_trailing(gap);
    }
}

/// What is still in the line, and the lines after it.
fn split(gap: &str) -> (String, String) {
    match gap.find('\n') {
        Some(end) => (gap[..end].to_owned(), gap[end..].to_owned()),
        None => (String::new(), gap.to_owned()),
    }
}

/// The line's beginning with its line end.
fn last_line(lines: &str) -> String {
    let last = lines.rsplit('\n').next().unwrap_or_default();
    let space: String = last.chars().take_while(|it| it.is_whitespace()).collect();
    format!("\n{space}")
}

fn text(raw: Option<&toml_edit::RawString>) -> &str {
    raw.and_then(|raw| raw.as_str()).unwrap_or_default()
}
