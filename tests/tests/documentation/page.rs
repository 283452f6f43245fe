//! A page of Markdown, as far as its checks need it: fenced blocks, links, anchors.

use std::collections::BTreeSet;

/// A fenced block.
#[derive(Debug)]
pub(crate) struct Block {
    /// What stands behind the fence: `sh`, `rust,ignore`.
    pub(crate) language: String,
    /// Of the fence, from 1.
    pub(crate) line: usize,
    pub(crate) text: String,
}

/// A link, as it is written.
#[derive(Debug)]
pub(crate) struct Link {
    /// From 1.
    pub(crate) line: usize,
    pub(crate) target: String,
    /// The text, where it is nothing but code.
    pub(crate) code: Option<String>,
}

/// A page in parts.
#[derive(Debug, Default)]
pub(crate) struct Page {
    pub(crate) blocks: Vec<Block>,
    pub(crate) links: Vec<Link>,
    /// Code within sentences, with its line.
    pub(crate) code: Vec<(usize, String)>,
    /// Of the headings, as GitHub and mdBook name them.
    pub(crate) anchors: BTreeSet<String>,
}

/// Stands for a piece of code while links are looked for.
const CODE: char = '\u{fffc}';

impl Page {
    pub(crate) fn parse(text: &str) -> Self {
        let mut page = Self::default();
        let mut open: Option<Block> = None;
        for (index, line) in text.lines().enumerate() {
            let fence = line.trim_start().strip_prefix("```");
            match (&mut open, fence) {
                (Some(_), Some("")) => page.blocks.extend(open.take()),
                (Some(block), _) => {
                    block.text.push_str(line);
                    block.text.push('\n');
                }
                (None, Some(language)) => {
                    open = Some(Block {
                        language: language.to_owned(),
                        line: index + 1,
                        text: String::new(),
                    });
                }
                (None, None) => page.read_prose(index + 1, line),
            }
        }
        let line = open.map(|block| block.line);
        assert_eq!(line, None, "a block that begins in this line never ends");
        page
    }

    fn read_prose(&mut self, line: usize, text: &str) {
        if text.starts_with('#') {
            let anchor = anchor(text.trim_start_matches('#').trim());
            // GitHub counts headings of one name; nobody links to the second.
            self.anchors.insert(anchor);
        }
        // Code is no link, whatever it looks like; one that is a link's text has its place in it.
        let (mut prose, mut code) = (String::new(), Vec::new());
        for (index, part) in text.split('`').enumerate() {
            if index % 2 == 0 {
                prose.push_str(part);
            } else {
                prose.push(CODE);
                code.push(part);
            }
        }
        for (at, _) in prose.match_indices("](") {
            let (before, behind) = (&prose[..at], &prose[at + 2..]);
            let target = behind.split_once(')').map_or(behind, |(target, _)| target);
            let is_code = before
                .strip_suffix(CODE)
                .is_some_and(|rest| rest.ends_with('['));
            let which = before.matches(CODE).count().checked_sub(1);
            self.links.push(Link {
                line,
                target: target.to_owned(),
                code: which.filter(|_| is_code).map(|at| code[at].to_owned()),
            });
        }
        self.code
            .extend(code.into_iter().map(|part| (line, part.to_owned())));
    }
}

/// The anchor of a heading.
fn anchor(heading: &str) -> String {
    let kept = heading.to_lowercase();
    let kept = kept
        .chars()
        .filter(|one| one.is_alphanumeric() || matches!(one, ' ' | '-' | '_'));
    kept.map(|one| if one == ' ' { '-' } else { one }).collect()
}
