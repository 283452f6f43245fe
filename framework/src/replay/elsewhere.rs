//! Another build of the robot, asked line by line: a program that was started with `--replay FILE --answer`.
//!
//! ```text
//! asked:     {"play":{"instance":"Control","position":7}}     {"value":{"instance":"Control","output":"speed"}}
//! answered:  {"outputs":[{"node":…,"output":…,"digest":…}]}   0.25
//! ```

use std::io::{BufRead, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::mpsc::{self, Receiver};
use std::thread;
use std::time::Duration;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::{Played, Source};
use crate::error::{Error, Result};

/// Characters of what the other build says that are quoted.
const QUOTED: usize = 200;

/// How long its last words may take when it has ended: somebody else may hold the other end.
const PATIENCE: Duration = Duration::from_secs(2);

/// What one line asks for.
#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Question {
    Play { instance: String, position: usize },
    Value { instance: String, output: String },
}

/// Answers the lines of one reader, each with one line, until there are no more.
///
/// # Errors
/// If a line is no question, or one side is gone.
pub fn answer(
    source: &mut dyn Source,
    questions: impl BufRead,
    answers: &mut dyn Write,
) -> Result<()> {
    for line in questions.lines() {
        let answer = match serde_json::from_str(&line?)? {
            Question::Play { instance, position } => {
                serde_json::to_value(source.play(&instance, position)?)?
            }
            Question::Value { instance, output } => {
                serde_json::to_value(source.value(&instance, &output)?)?
            }
        };
        writeln!(answers, "{answer}")?;
        answers.flush()?;
    }
    Ok(())
}

/// A program that answers; it ends when this is dropped.
#[derive(Debug)]
pub struct Elsewhere {
    child: Child,
    /// Questions and answers; `None` once it is to end. It waits for neither then.
    pipes: Option<(ChildStdin, BufReader<ChildStdout>)>,
    /// What it said last on standard error, once it has ended.
    last_words: Receiver<String>,
}

impl Elsewhere {
    /// Starts the program for a recording.
    ///
    /// # Errors
    /// If it cannot be started.
    pub fn start(program: &Path, recording: &Path) -> Result<Self> {
        let mut child = Command::new(program)
            .arg("--replay")
            .arg(recording)
            .arg("--answer")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(|error| {
                Error::from(error).context(format!("cannot start {}", program.display()))
            })?;
        let missing = || Error::new("its input and output were asked for");
        let questions = child.stdin.take().ok_or_else(missing)?;
        let answers = child.stdout.take().ok_or_else(missing)?;
        let said = child.stderr.take().ok_or_else(missing)?;
        let (told, last_words) = mpsc::channel();
        // It reads until there is no more, so that the program never waits for it.
        thread::spawn(move || told.send(last_words_of(said)));
        Ok(Self {
            child,
            pipes: Some((questions, BufReader::new(answers))),
            last_words,
        })
    }

    fn ask<T: DeserializeOwned>(&mut self, question: &Question) -> Result<T> {
        let asked = self.answer_to(question);
        let line = match asked {
            Ok(line) if line.ends_with(b"\n") => line,
            _ => return Err(self.ended()),
        };
        serde_json::from_slice(&line).map_err(|_| {
            Error::new(format!(
                "the other build says `{}` where its answer should be: if a node of it prints that on standard output, compare with a revision in which it does not",
                quoted(&line)
            ))
        })
    }

    /// What there is to say where no answer comes.
    fn ended(&mut self) -> Error {
        self.pipes = None;
        let status = match self.child.wait() {
            Ok(status) => status.to_string(),
            Err(error) => error.to_string(),
        };
        let words = self.last_words.recv_timeout(PATIENCE).unwrap_or_default();
        let words = match words.is_empty() {
            true => String::new(),
            false => format!(", it said last: {words}"),
        };
        Error::new(format!(
            "the other build ended without an answer ({status}){words}; one that is older than `--against` does not know `--answer`"
        ))
    }

    /// The next line that it says.
    fn answer_to(&mut self, question: &Question) -> Result<Vec<u8>> {
        let pipes = self.pipes.as_mut();
        let (questions, answers) = pipes.ok_or_else(|| Error::new("it was told to end"))?;
        writeln!(questions, "{}", serde_json::to_string(question)?)?;
        questions.flush()?;
        let mut line = Vec::new();
        answers.read_until(b'\n', &mut line)?;
        Ok(line)
    }
}

/// Of all that comes, the last line that begins as errors do, or else the last one at all.
fn last_words_of(said: impl Read) -> String {
    let (mut error, mut last) = (None, String::new());
    let mut said = BufReader::new(said);
    let mut line = Vec::new();
    while said.read_until(b'\n', &mut line).is_ok_and(|read| read > 0) {
        let text = quoted(&line);
        if text.starts_with("error: ") {
            error = Some(text);
        } else if !text.is_empty() {
            last = text;
        }
        line.clear();
    }
    error.unwrap_or(last)
}

/// As much of a line as fits.
fn quoted(line: &[u8]) -> String {
    let text = String::from_utf8_lossy(line);
    text.trim().chars().take(QUOTED).collect()
}

impl Source for Elsewhere {
    fn play(&mut self, instance: &str, position: usize) -> Result<Played> {
        self.ask(&Question::Play {
            instance: instance.to_owned(),
            position,
        })
    }

    fn value(&mut self, instance: &str, output: &str) -> Result<Option<Value>> {
        self.ask(&Question::Value {
            instance: instance.to_owned(),
            output: output.to_owned(),
        })
    }
}

impl Drop for Elsewhere {
    fn drop(&mut self) {
        self.pipes = None;
        // It has no more questions to answer, and nothing to lose.
        let _ = self.child.wait();
    }
}
