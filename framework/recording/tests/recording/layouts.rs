//! The reader in Python, `docs/clients/recording.py`: it reads what the reference reads, and refuses what it refuses.

use std::fmt::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};

use fastrand::Rng;
use hulkgen_recording::layout::{Enum, Layout, Struct, Values};
use serde_json::json;

/// Layouts that are drawn.
const LAYOUTS: usize = 400;

/// For each: bytes of a value, and the same with a byte changed or with their end cut off.
const CHANGED: usize = 5;

/// Parts inside of each other that a drawn layout has at most, and a drawn value of one that contains itself.
const DEPTH: usize = 4;

/// A layout inside of so many structs and enums.
fn drawn(random: &mut Rng, depth: usize, around: usize) -> Layout {
    let part = |random: &mut Rng| Box::new(drawn(random, depth - 1, around));
    match random.u8(..if depth == 0 { 9 } else { 18 }) {
        0 => Layout::Unit,
        1 => Layout::Bool,
        2 => Layout::Character,
        3 => Layout::Text,
        4 => Layout::Bytes,
        5 => Layout::Float(if random.bool() { 32 } else { 64 }),
        6 | 7 => Layout::Unsigned(8 << random.u8(..5)),
        8 => Layout::Signed(8 << random.u8(..5)),
        9 => Layout::Option(part(random)),
        10 => Layout::List(part(random)),
        11 => {
            // Numbers that are not whole are no keys.
            let keys = [
                Layout::Text,
                Layout::Character,
                Layout::Bool,
                Layout::Signed(32),
                Layout::Tuple(vec![Layout::Unsigned(16), Layout::Text]),
            ];
            let key = random.choice(keys).unwrap_or_default();
            Layout::Map(Box::new((key, *part(random))))
        }
        12 => {
            let items = 0..random.usize(..4);
            Layout::Tuple(items.map(|_| drawn(random, depth - 1, around)).collect())
        }
        13 | 14 => structure(random, depth, around),
        15 | 16 => Layout::Enum(Enum {
            name: "Enum".to_owned(),
            variants: named(random, |random| match random.bool() {
                true => structure(random, depth, around + 1),
                false => drawn(random, depth - 1, around + 1),
            }),
        }),
        _ if around == 0 => Layout::Unknown,
        _ => {
            let again = Box::new(Layout::Again(1 + random.usize(..around)));
            match random.bool() {
                true => Layout::Option(again),
                false => Layout::List(again),
            }
        }
    }
}

fn structure(random: &mut Rng, depth: usize, around: usize) -> Layout {
    Layout::Struct(Struct {
        name: "Struct".to_owned(),
        fields: named(random, |random| drawn(random, depth - 1, around + 1)),
    })
}

fn named(random: &mut Rng, mut one: impl FnMut(&mut Rng) -> Layout) -> Vec<(String, Layout)> {
    let all = 0..random.usize(1..5);
    all.map(|number| (format!("part_{number}"), one(random)))
        .collect()
}

/// Bytes of a value of the layout, as postcard writes them.
struct Drawing<'random> {
    random: &'random mut Rng,
    bytes: Vec<u8>,
}

impl Drawing<'_> {
    fn number(&mut self, bits: u8) {
        let bits = self.random.u32(..=u32::from(bits.min(127)));
        let mut number = self.random.u128(..1 << bits);
        while number >= 0x80 {
            self.bytes.push(number as u8 | 0x80);
            number >>= 7;
        }
        self.bytes.push(number as u8);
    }

    fn any(&mut self, count: usize) {
        let bytes = (0..count).map(|_| self.random.u8(..));
        self.bytes.extend(bytes);
    }

    /// None where parts lie too deep in each other already.
    fn count(&mut self, below: u8, depth: usize) -> u8 {
        let count = match depth < 3 * DEPTH {
            true => self.random.u8(..below),
            false => 0,
        };
        self.bytes.push(count);
        count
    }

    fn text(&mut self, characters: usize) {
        let text: String = (0..characters).map(|_| self.random.char(..)).collect();
        self.bytes.push(text.len() as u8);
        self.bytes.extend(text.bytes());
    }

    fn value<'l>(&mut self, layout: &'l Layout, around: &[&'l Layout], depth: usize) {
        let depth = depth + 1;
        match layout {
            Layout::Unknown | Layout::Unit => {}
            Layout::Bool => _ = self.count(2, 0),
            Layout::Signed(8) | Layout::Unsigned(8) => self.any(1),
            Layout::Signed(bits) | Layout::Unsigned(bits) => self.number(*bits),
            Layout::Float(bits) => self.any(usize::from(bits / 8)),
            Layout::Character => self.text(1),
            Layout::Text => {
                let length = self.random.usize(..9);
                self.text(length);
            }
            Layout::Bytes => {
                let count = self.count(20, 0);
                self.any(count.into());
            }
            Layout::Option(inner) => {
                for _ in 0..self.count(2, depth) {
                    self.value(inner, around, depth);
                }
            }
            Layout::List(item) => {
                for _ in 0..self.count(4, depth) {
                    self.value(item, around, depth);
                }
            }
            Layout::Map(both) => {
                for _ in 0..self.count(4, depth) {
                    self.value(&both.0, around, depth);
                    self.value(&both.1, around, depth);
                }
            }
            Layout::Tuple(items) => items
                .iter()
                .for_each(|item| self.value(item, around, depth)),
            Layout::Struct(of) => {
                let around = [around, &[layout]].concat();
                for (_, field) in &of.fields {
                    self.value(field, &around, depth);
                }
            }
            Layout::Enum(of) => {
                let number = self.count(of.variants.len() as u8, 0);
                let around = [around, &[layout]].concat();
                self.value(&of.variants[usize::from(number)].1, &around, depth);
            }
            Layout::Again(up) => {
                let place = around.len() - up;
                self.value(around[place], &around[..place], depth);
            }
        }
    }
}

/// A line of JSON: a layout, bytes, and what the reference makes of them; without `value` it refuses them.
fn case(layout: &Layout, bytes: &[u8]) -> (String, bool) {
    let mut text = String::new();
    for byte in bytes {
        write!(text, "{byte:02x}").expect("texts take everything");
    }
    let mut line = json!({ "layout": layout, "bytes": text });
    let mut values = Values::new(bytes);
    let read = values.take(layout);
    let is_read = read.is_ok() && values.is_empty();
    if let Some(value) = read.ok().filter(|_| is_read) {
        line["value"] = value;
    }
    (line.to_string(), is_read)
}

#[test]
fn python_reads_every_layout() {
    let script = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../docs/clients/test_recording.py"
    );
    let mut has_mcap = Command::new("python3");
    has_mcap.args(["-c", "import mcap"]).stderr(Stdio::null());
    if !has_mcap.status().is_ok_and(|status| status.success()) {
        return framework::testing::skip("python_reads_every_layout", "pip install mcap");
    }
    let random = &mut Rng::with_seed(1);
    let (mut lines, mut read) = (String::new(), 0);
    for _ in 0..LAYOUTS {
        let layout = drawn(random, DEPTH, 0);
        let mut drawing = Drawing {
            random: &mut *random,
            bytes: Vec::new(),
        };
        drawing.value(&layout, &[], 0);
        let whole = drawing.bytes;
        for change in 0..=CHANGED {
            let mut bytes = whole.clone();
            if change > 0 && !bytes.is_empty() {
                let place = random.usize(..bytes.len());
                bytes[place] = random.u8(..);
                if change % 2 == 0 {
                    bytes.truncate(place);
                }
            }
            let (line, is_read) = case(&layout, &bytes);
            read += usize::from(is_read);
            writeln!(lines, "{line}").expect("texts take everything");
        }
    }
    let folder = tempfile::tempdir().expect("a folder");
    let corpus: &Path = &folder.path().join("corpus");
    std::fs::write(corpus, lines).expect("the folder is ours");
    let output = Command::new("python3").arg(script).arg(corpus).output();
    let output = output.expect("it was there a moment ago");
    let [said, error] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
    assert!(output.status.success(), "{said}{error}");
    let all = LAYOUTS * (1 + CHANGED);
    assert_eq!(said.trim(), format!("{all} read, {} refused", all - read));
    assert!((all / 4..all).contains(&read), "{read} of {all}");
}
