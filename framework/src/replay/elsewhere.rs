//! Another build of the robot, asked line by line: a program that was started with `--replay FILE --answer`.
//!
//! ```text
//! asked:     {"play":{"instance":"Control","position":7}}     {"value":{"instance":"Control","output":"speed"}}
//! answered:  {"outputs":[{"node":…,"output":…,"digest":…}]}   0.25
//! ```

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::{Played, Source};
use crate::error::{Error, Result};

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
    /// `None` while it is being dropped.
    questions: Option<ChildStdin>,
    answers: BufReader<ChildStdout>,
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
            // What it has to say of options that it does not know is no help here.
            .stderr(Stdio::null())
            .spawn()
            .map_err(|error| {
                Error::from(error).context(format!("cannot start {}", program.display()))
            })?;
        let missing = || Error::new("its input and output were asked for");
        let questions = child.stdin.take().ok_or_else(missing)?;
        let answers = child.stdout.take().ok_or_else(missing)?;
        Ok(Self {
            child,
            questions: Some(questions),
            answers: BufReader::new(answers),
        })
    }

    fn ask<T: DeserializeOwned>(&mut self, question: &Question) -> Result<T> {
        let asked = self.send(question).and_then(|()| {
            let mut line = String::new();
            self.answers.read_line(&mut line)?;
            Ok(line)
        });
        let line = asked.unwrap_or_default();
        serde_json::from_str(&line).map_err(|_| {
            Error::new(
                "the other build does not answer: it is older than `--against`, or it cannot read the recording",
            )
        })
    }

    fn send(&mut self, question: &Question) -> Result<()> {
        let questions = self.questions.as_mut();
        let questions = questions.ok_or_else(|| Error::new("it was told to end"))?;
        writeln!(questions, "{}", serde_json::to_string(question)?)?;
        Ok(questions.flush()?)
    }
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
        self.questions = None;
        // It has no more questions to answer, and nothing to lose.
        let _ = self.child.wait();
    }
}
