//! `build`: generate, build for the target's machine, and tell whether the program would start there.

use camino::Utf8PathBuf;
use serde_json::json;

use super::Failure;
use super::cargo::{ForProcessor, OWN_PROFILE, Request};
use super::generate;
use super::run::{absolute, choose_target, profile};
use super::session::Session;
use crate::arguments::{self, TextOrJson};
use crate::cache::user_folder;
use crate::cross::{self, Elf, Tools, Wanted, WrongTriple};
use crate::outcome::{Outcome, Refusal};
use crate::resolve::robot::Target;

/// A program that was built, and what it needs.
struct Program<'a> {
    target: &'a Target,
    profile: &'a str,
    executable: Utf8PathBuf,
    size: u64,
    elf: Elf,
    wanted: Option<Wanted>,
    objections: Vec<String>,
}

pub(super) fn run(
    session: &mut Session<'_>,
    build: &arguments::BuildTarget,
) -> Result<Outcome, Failure> {
    let understood = session.understand()?;
    let target = choose_target(&understood.robot, build.target.as_deref())?;
    let wanted = target.triple.as_deref().map(wanted_of).transpose()?;
    session.note_diagnostics();
    if session.diagnostics.has_errors() {
        return Ok(Outcome::Bad);
    }
    let triple = wanted.as_ref().map(|wanted| wanted.triple.as_str());
    let root = session.workspace.root();
    let processor = ForProcessor::of(root, triple, target.cpu.as_deref())?;
    generate::write(session, &understood)?;
    let profile = profile(build.build.profile.as_deref(), target).unwrap_or(OWN_PROFILE);
    let target_dir = build
        .build
        .target_dir
        .as_deref()
        .map(absolute)
        .transpose()?;
    let mut request = Request::build(&understood.robot, target, profile, target_dir);
    if let Some(triple) = &target.triple {
        let tools = Tools::bring(user_folder(), |what| session.terminal.note(what))?;
        request.cross(&tools, triple);
    }
    processor.apply(&mut request);
    // What is left out of the program is not sent to the robot either; panics keep file and line.
    request.strip();
    let said = request.said(session, session.terminal.colors_notes())?;
    session.diagnostics = said.diagnostics(session, &understood)?;
    session.note_diagnostics();
    if !said.success {
        return Ok(Outcome::Bad);
    }
    let executable = said
        .executable
        .ok_or_else(|| Refusal::bad("cargo did not say where the program is"))?;
    let (elf, size) = cross::inspect(&executable)?;
    let objections = wanted
        .as_ref()
        .map(|wanted| cross::objections(&elf, wanted))
        .unwrap_or_default();
    let program = Program {
        target,
        profile,
        executable,
        size,
        elf,
        wanted,
        objections,
    };
    session.terminal.data(&match build.format {
        TextOrJson::Text => program.text(),
        TextOrJson::Json => program.json(),
    })?;
    if program.objections.is_empty() {
        return Ok(Outcome::Good);
    }
    let reasons = program.objections.join("; ");
    let name = &program.target.name;
    Err(Refusal::bad(format!("the program would not start on `{name}`: {reasons}"))
        .help("find out with `cargo tree` which crate asks for it, or name a newer glibc behind the target's triple")
        .into())
}

fn wanted_of(triple: &str) -> Result<Wanted, Refusal> {
    Wanted::parse(triple).map_err(|wrong| Refusal::bad(wrong.to_string()).help(WrongTriple::HELP))
}

impl Program<'_> {
    fn text(&self) -> String {
        let glibc = self.elf.glibc.map(|version| version.to_string());
        let there = self.wanted.as_ref().and_then(|wanted| wanted.glibc);
        format!(
            "{}\n  size       {:.1} MiB\n  glibc      {}{}\n  libraries  {}\n",
            self.executable,
            self.size as f64 / f64::from(1 << 20),
            glibc.unwrap_or_else(|| "none".to_owned()),
            there.map_or(String::new(), |there| format!(" (the target has {there})")),
            self.elf.libraries.join(", "),
        )
    }

    fn json(&self) -> String {
        let wanted = self.wanted.as_ref();
        let answer = json!({
            "version": 1,
            "target": self.target.name,
            "executable": self.executable,
            "triple": wanted.map(|wanted| &wanted.triple),
            "cpu": self.target.cpu,
            "profile": self.profile,
            "size": self.size,
            "glibc": self.elf.glibc.map(|version| version.to_string()),
            "glibc_of_target": wanted.and_then(|wanted| wanted.glibc).map(|version| version.to_string()),
            "interpreter": self.elf.interpreter,
            "libraries": self.elf.libraries,
            "objections": self.objections,
        });
        format!("{answer:#}\n")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triple_without_a_version_where_one_should_be_is_refused() {
        let refusal = wanted_of("x86_64-unknown-linux-gnu.").expect_err("it ends with a full stop");
        assert!(refusal.help.is_some_and(|help| help.contains("2.28")));
    }
}
