//! A bound of how deep a text is nested, from its characters alone: an order of magnitude faster than splitting it into
//! tokens, which then is needed only for a text that nobody has ever written.
//!
//! Invariant: what is said to be shallow is never counted deeper by [`super::count`]. Whatever makes the two disagree
//! about where a string, a comment or a character ends is said to be not shallow, and counted.

/// What stands at one level of brackets.
#[derive(Clone, Copy, Default)]
struct Level {
    /// Marks since the last `,` or `;`.
    marks: usize,
    /// Each `<`, whether it was closed or not.
    less: usize,
    /// `else` that follow one another.
    branches: usize,
    after_block: bool,
}

struct Reader<'a> {
    text: &'a [u8],
    at: usize,
    levels: Vec<Level>,
    /// Of all levels but the innermost.
    around: usize,
}

/// Whether a text is certainly nested at most `deepest` deep; for all others nothing is said.
pub(super) fn is_shallow(text: &str, deepest: usize) -> bool {
    let mut reader = Reader {
        text: text.as_bytes(),
        at: 0,
        levels: vec![Level::default()],
        around: 0,
    };
    while let Some(byte) = reader.peek(0) {
        if reader.step(byte).is_none() || reader.depth() > deepest {
            return false;
        }
    }
    true
}

impl Level {
    fn depth(self) -> usize {
        1 + self.marks + self.less + self.branches
    }
}

impl<'a> Reader<'a> {
    fn depth(&self) -> usize {
        self.around + self.levels.last().copied().map_or(0, Level::depth)
    }

    fn peek(&self, ahead: usize) -> Option<u8> {
        self.text.get(self.at + ahead).copied()
    }

    /// The next token, comment or space; `None` where nothing can be said any more.
    fn step(&mut self, byte: u8) -> Option<()> {
        match byte {
            b' ' | b'\t' | b'\n' | b'\r' => self.at += 1,
            b'/' if self.peek(1) == Some(b'/') => self.line_comment(),
            b'/' if self.peek(1) == Some(b'*') => self.block_comment()?,
            _ => self.token(byte)?,
        }
        Some(())
    }

    fn token(&mut self, byte: u8) -> Option<()> {
        let word = match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'_' => self.word(),
            _ => &[],
        };
        let level = self.levels.last_mut()?;
        if word == b"else" {
            level.branches += 1;
        } else if level.after_block {
            level.branches = 0;
        }
        level.after_block = false;
        match byte {
            _ if !word.is_empty() => self.after_word(word),
            b'0'..=b'9' => {
                self.word();
                Some(())
            }
            b'"' => self.string(),
            b'\'' => self.character_or_lifetime(),
            b'(' | b'[' | b'{' => self.open(byte),
            b')' | b']' | b'}' => self.close(),
            _ => self.mark(byte),
        }
    }

    /// Letters, digits and underscores from here on.
    fn word(&mut self) -> &'a [u8] {
        let rest = &self.text[self.at..];
        let is_other = |byte: &u8| !byte.is_ascii_alphanumeric() && *byte != b'_';
        let end = rest.iter().position(is_other).unwrap_or(rest.len());
        self.at += end;
        &rest[..end]
    }

    /// What a word begins that is none: `r"…"`, `br#"…"#`, `r#type`.
    fn after_word(&mut self, word: &[u8]) -> Option<()> {
        let is_raw = [b"r".as_slice(), b"br", b"cr"].contains(&word);
        if !is_raw || !matches!(self.peek(0), Some(b'"' | b'#')) {
            return Some(());
        }
        let hashes = self.text[self.at..].iter();
        let hashes = hashes.take_while(|byte| **byte == b'#').count();
        match self.peek(hashes) {
            Some(b'"') => self.raw_string(hashes),
            _ if word == b"r" && hashes == 1 => {
                self.at += 1;
                self.word();
                Some(())
            }
            _ => None,
        }
    }

    fn open(&mut self, bracket: u8) -> Option<()> {
        let level = self.levels.last_mut()?;
        if bracket == b'{' {
            (level.marks, level.less) = (0, 0);
            level.after_block = true;
        }
        self.around += level.depth();
        self.levels.push(Level::default());
        self.at += 1;
        Some(())
    }

    fn close(&mut self) -> Option<()> {
        self.levels.pop();
        self.around -= self.levels.last()?.depth();
        self.at += 1;
        Some(())
    }

    fn mark(&mut self, byte: u8) -> Option<()> {
        let level = self.levels.last_mut()?;
        match byte {
            b',' => level.marks = 0,
            b';' => (level.marks, level.less, level.branches) = (0, 0, 0),
            b'<' => level.less += 1,
            b'~' | b'!' | b'@' | b'#' | b'$' | b'%' | b'^' | b'&' | b'*' | b'-' | b'=' | b'+'
            | b'|' | b':' | b'>' | b'.' | b'?' | b'/' => level.marks += 1,
            _ => return None,
        }
        self.at += 1;
        Some(())
    }

    /// `'a'`, else `'a`.
    fn character_or_lifetime(&mut self) -> Option<()> {
        let length = match self.peek(1)? {
            b'\\' => return self.character(),
            0..0x80 => 1,
            0x80..0xe0 => 2,
            0xe0..0xf0 => 3,
            _ => 4,
        };
        if self.peek(1 + length) == Some(b'\'') {
            return self.character();
        }
        self.levels.last_mut()?.marks += 1;
        self.at += 1;
        Some(())
    }

    /// From its first quote to behind its suffix.
    fn character(&mut self) -> Option<()> {
        // What is escaped may be a quote, and so may be what is not.
        self.at += if self.peek(1)? == b'\\' { 3 } else { 2 };
        let rest = self.text.get(self.at..)?;
        // The longest one is `'\u{10_ff_ff}'` with underscores, of which nobody writes more.
        let end = rest.iter().take(16).position(|byte| *byte == b'\'')?;
        self.at += end + 1;
        self.word();
        Some(())
    }

    fn string(&mut self) -> Option<()> {
        self.at += 1;
        loop {
            match self.peek(0)? {
                b'\\' => self.at += 2,
                b'"' => break,
                _ => self.at += 1,
            }
        }
        self.at += 1;
        self.word();
        Some(())
    }

    /// From the hashes before the first quote on.
    fn raw_string(&mut self, hashes: usize) -> Option<()> {
        self.at += hashes + 1;
        loop {
            let rest = &self.text[self.at..];
            self.at += rest.iter().position(|byte| *byte == b'"')? + 1;
            let after = self.text.get(self.at..self.at + hashes)?;
            if after.iter().all(|byte| *byte == b'#') {
                break;
            }
        }
        self.at += hashes;
        self.word();
        Some(())
    }

    fn line_comment(&mut self) {
        let rest = &self.text[self.at..];
        let end = rest.iter().position(|byte| *byte == b'\n');
        self.at += end.unwrap_or(rest.len());
    }

    fn block_comment(&mut self) -> Option<()> {
        let mut depth = 0_usize;
        loop {
            match (self.peek(0)?, self.peek(1)?) {
                (b'/', b'*') => {
                    depth += 1;
                    self.at += 2;
                }
                (b'*', b'/') => {
                    depth -= 1;
                    self.at += 2;
                    if depth == 0 {
                        return Some(());
                    }
                }
                _ => self.at += 1,
            }
        }
    }
}
