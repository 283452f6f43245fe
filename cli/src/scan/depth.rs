//! How deep a text is nested: what is too deep is refused before anything recursive reads it.
//!
//! Invariant: does not recurse itself, so that no text can exhaust the stack.

mod bound;

use proc_macro2::{Delimiter, Spacing, Span, TokenStream, TokenTree, token_stream};

/// Brackets, operators and generics around one another; no honest code has a tenth of it.
const DEEPEST: usize = 500;

/// Tokens at one level of brackets.
struct Level {
    tokens: token_stream::IntoIter,
    /// Operators since the last `,` or `;`: each may stand around what follows.
    operators: usize,
    /// Each open `<`, and whether it is the second of `<<`.
    generics: Vec<bool>,
    /// `else` that follow one another.
    branches: usize,
    after_block: bool,
    /// An attribute may follow.
    after_hash: bool,
    /// `-` or `=`, which makes an arrow of a `>`.
    after_arrow: bool,
    /// A `<` that another one may follow without a space.
    after_less: bool,
}

/// How much deeper than what is around it a comment for documentation is: `#[doc = "…"]`.
const DOCUMENTATION: usize = 2;

/// The first place that is nested too deeply; a text that cannot be split into tokens has none.
pub(super) fn too_deep(text: &str) -> Option<Span> {
    // syn leaves out a first line for shells, in which there may be anything.
    let behind = text
        .strip_prefix("#!")
        .and_then(|text| text.split_once('\n'));
    let texts = [Some(text), behind.map(|(_, text)| text)];
    texts.into_iter().flatten().find_map(|text| {
        let is_shallow = bound::is_shallow(text, DEEPEST - DOCUMENTATION);
        (!is_shallow).then(|| count(text, DEEPEST)).flatten()
    })
}

/// The first place that is nested deeper than `deepest`, by tokens.
fn count(text: &str, deepest: usize) -> Option<Span> {
    let tokens: TokenStream = text.parse().ok()?;
    let mut levels = vec![Level::new(tokens)];
    // Of all levels but the innermost.
    let mut around = 0;
    while let Some(level) = levels.last_mut() {
        let Some(token) = level.tokens.next() else {
            levels.pop();
            around -= levels.last().map_or(0, Level::depth);
            continue;
        };
        let span = token.span();
        level.see(&token);
        let depth = level.depth();
        if around + depth > deepest {
            return Some(span);
        }
        if let TokenTree::Group(group) = token {
            around += depth;
            levels.push(Level::new(group.stream()));
        }
    }
    None
}

impl Level {
    fn new(tokens: TokenStream) -> Self {
        Self {
            tokens: tokens.into_iter(),
            operators: 0,
            generics: Vec::new(),
            branches: 0,
            after_block: false,
            after_hash: false,
            after_arrow: false,
            after_less: false,
        }
    }

    fn depth(&self) -> usize {
        1 + self.operators + self.generics.len() + self.branches
    }

    fn see(&mut self, token: &TokenTree) {
        let is_else = matches!(token, TokenTree::Ident(word) if word == "else");
        if is_else {
            self.branches += 1;
        } else if self.after_block {
            self.branches = 0;
        }
        self.after_block = false;
        let (after_hash, after_arrow) = (self.after_hash, self.after_arrow);
        let after_less = std::mem::take(&mut self.after_less);
        (self.after_hash, self.after_arrow) = (false, false);
        match token {
            TokenTree::Punct(mark) => match mark.as_char() {
                ',' => {
                    self.operators = 0;
                    // No comma stands right in `<A as B>`: it was a shift.
                    while self.generics.last() == Some(&true) {
                        self.generics.truncate(self.generics.len() - 2);
                    }
                }
                ';' => {
                    (self.operators, self.branches) = (0, 0);
                    self.generics.clear();
                }
                '#' => self.after_hash = true,
                '!' if after_hash => {}
                '<' => {
                    self.generics.push(after_less);
                    self.after_less = !after_less && mark.spacing() == Spacing::Joint;
                }
                '>' if !after_arrow => drop(self.generics.pop()),
                mark_of_arrow => {
                    self.after_arrow =
                        matches!(mark_of_arrow, '-' | '=') && mark.spacing() == Spacing::Joint;
                    self.operators += 1;
                }
            },
            TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => {
                self.operators = 0;
                self.generics.clear();
                self.after_block = true;
            }
            TokenTree::Group(_) | TokenTree::Ident(_) | TokenTree::Literal(_) => {}
        }
    }
}

#[cfg(test)]
mod tests;
