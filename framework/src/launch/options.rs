//! The command line of a generated binary.

use std::ffi::OsString;
use std::path::PathBuf;
use std::time::Duration;

use lexopt::{Arg, Parser, ValueExt};

use super::replay::Replaying;
use super::size::{size, written};
use super::{Listening, Target};
use crate::error::{Error, Result};
use crate::time;

/// What the command line asks for.
#[derive(Debug)]
pub(super) enum Command {
    Run(Box<Options>),
    Help,
}

/// How to run.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Options {
    /// Until a signal if left out.
    pub(super) duration: Option<Duration>,
    pub(super) format: Format,
    /// Instead of running.
    pub(super) check_parameters: bool,
    pub(super) parameters: Option<PathBuf>,
    pub(super) location: Option<String>,
    /// (path, value)
    pub(super) settings: Vec<(String, String)>,
    /// For files of this run.
    pub(super) run_folder: PathBuf,
    pub(super) record: Record,
    /// Outputs that are recorded in channels of their own.
    pub(super) record_outputs: Vec<String>,
    /// Bytes, instead of what the manifest says.
    pub(super) recording_budget: Option<u64>,
    /// Instead of running.
    pub(super) is_replay: bool,
    pub(super) replay: Replaying,
    /// Also on a simulated target, threads ask for their `scheduling`.
    pub(super) is_real_time: bool,
    /// Instead of running.
    pub(super) scenario: Option<PathBuf>,
    /// The first seed of a scenario.
    pub(super) seed: Option<u64>,
    /// With how many seeds a scenario is played.
    pub(super) repeat: Option<u64>,
    /// On how many threads the robots of a scenario live.
    pub(super) threads: Option<usize>,
    /// Whether a scenario tells digests.
    pub(super) digests: bool,
    /// Instead of running: one of the hardware's tools.
    pub(super) tool: Option<String>,
    /// `--listen`: nobody may come if it is `off`.
    pub(super) listen: Option<String>,
    pub(super) token: Option<String>,
    pub(super) is_read_only: bool,
    /// Robots that this one's page may show, and whose pages may show this one.
    pub(super) peers: Vec<String>,
    pub(super) web_root: Option<PathBuf>,
    /// Everything after `--`.
    pub(super) hardware: Vec<String>,
}

impl Options {
    /// Whether a program or a person reads answers from standard output; else the program has nothing to say there.
    pub(super) fn answers(&self) -> bool {
        // Of a recording; else it is played, or there is none.
        let is_question = self.replay.is_question() || !self.settings.is_empty();
        self.format == Format::Json
            || self.scenario.is_some()
            || self.tool.is_some()
            || self.is_replay && is_question
    }

    /// What a server has to know; `None`: there is none.
    pub(super) fn listening(&self, target: &Target) -> Option<Listening> {
        let listening = Listening {
            target: target.name,
            graph: target.graph,
            address: self.listen.clone(),
            socket: None,
            token: self.token.clone(),
            is_read_only: self.is_read_only,
            peers: self.peers.clone(),
            web_root: self.web_root.clone(),
        };
        (self.listen.as_deref() != Some("off")).then_some(listening)
    }
}

/// Whether and where the run is recorded.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) enum Record {
    /// On a simulated target: as `On`.
    #[default]
    Simulated,
    /// Into the run folder.
    On,
    Off,
    Into(PathBuf),
}

/// How the run is reported at its end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Format {
    #[default]
    Text,
    Json,
}

/// How to use the binary.
pub(super) fn help(target: &Target) -> String {
    format!(
        "\
Robot {robot}, target {name}

Usage: {name} [OPTIONS] [-- HARDWARE OPTIONS]

  --for DURATION      stop after e.g. 10s, 500ms, 2m; without it on Ctrl-C
  --headless          show nothing but the status line
  --format FORMAT     text (default) or json: what is reported at the end
  --parameters DIR    instead of {parameters}
  --location NAME     layer of parameters; empty: none
  --set PATH=VALUE    a parameter, above all layers; may be repeated
  --check-parameters  load the parameters for every identity that a file names, and those of the hardware, report mistakes and end
  --run-folder DIR    for files of this run, instead of runs/<start>-<process>
  --runs DIR          where such a folder is made, instead of runs: `hulkgen run` names it where it is called elsewhere
  --scenario FILE     play it in lockstep in place of running; the exit status says whether it passed
  --seed NUMBER       what a scenario draws its random numbers from; 1 without it
  --repeat COUNT      play a scenario with so many seeds, one after the other
  --threads COUNT     let a scenario's robots live on so many threads; changes nothing but the time it takes
  --tool NAME         use a tool of the hardware in place of running; its command line stands after `--`
  --digests           tell a digest of all that each robot of a scenario wrote
  --listen ADDRESS    where clients connect, e.g. 0.0.0.0:4857; off: nowhere; default: this machine alone, port 4857 or a free one;
                      with --scenario: nowhere unless it is said, robots have this port and those behind it, and time passes as on the wall
  --token TOKEN       clients have to know it before they may change anything; without it none from other machines may
  --read-only         no client may change anything
  --peer HOST:PORT    another robot, as browsers name it: its page may show this one, and this one's page may show it; may be repeated
  --web-root DIR      files of the page from there instead of those in the program
  --record FILE       record into this file, which must not be there; on: into the run folder; off (default: on if simulated)
  --record-output PATH
                      record this output in a channel of its own, as JSON; may be repeated
  --recording-budget SIZE
                      what the recording keeps, e.g. 512MiB or 2GB, instead of {budget}
  --replay FILE       show a recording to clients as if the robot ran, as long as --for says
  --replay FILE --verify
                      run the cycles of a recording again and compare, bit for bit
  --tolerance NUMBER  with --verify: how much numbers may differ if it was recorded with other numerics, instead of 1e-6; 0: bits are compared
  --node NAME         with --replay: only what this node needs, and its outputs
  --replay FILE --set PATH=VALUE
                      what would change under other parameters
  --carry             with --set: cycles go on with the states that the one before them left
  --replay FILE --against PROGRAM [--against-name NAME]
                      what another build of the robot computes otherwise
  --replay FILE --answer
                      be that other build: questions on standard input
  --replay FILE --capture NODE --instance NAME --at CYCLE
                      what the node took and wrote in this cycle, as JSON
  --real-time         apply the manifest's `scheduling` on a simulated target, too
  --help              this text; behind `--`: what the hardware's own options do
",
        robot = target.robot,
        name = target.name,
        parameters = target.parameters,
        budget = written(target.recording_budget),
    )
}

pub(super) fn parse(arguments: impl IntoIterator<Item = OsString>) -> Result<Command> {
    let mut arguments = arguments.into_iter();
    let own: Vec<_> = arguments
        .by_ref()
        .take_while(|argument| argument != "--")
        .collect();
    let hardware = arguments.map(text).collect::<Result<_>>()?;
    let mut options = Options {
        hardware,
        ..Options::default()
    };
    let mut runs = PathBuf::from("runs");
    let mut run_folder = None;
    let mut parser = Parser::from_args(own);
    while let Some(argument) = parser.next()? {
        match argument {
            Arg::Long("for") => {
                options.duration = Some(time::duration(&parser.value()?.string()?)?)
            }
            // Nothing opens a window yet; scripts may say it already.
            Arg::Long("headless") => {}
            Arg::Long("format") => options.format = format_named(&parser.value()?.string()?)?,
            Arg::Long("check-parameters") => options.check_parameters = true,
            Arg::Long("parameters") => options.parameters = Some(parser.value()?.into()),
            Arg::Long("location") => options.location = Some(parser.value()?.string()?),
            Arg::Long("set") => options.settings.push(setting(&parser.value()?.string()?)?),
            Arg::Long("scenario") => options.scenario = Some(parser.value()?.into()),
            Arg::Long("seed") => options.seed = Some(parser.value()?.parse()?),
            Arg::Long("repeat") => options.repeat = Some(parser.value()?.parse()?),
            Arg::Long("threads") => options.threads = Some(parser.value()?.parse()?),
            Arg::Long("digests") => options.digests = true,
            Arg::Long("tool") => options.tool = Some(parser.value()?.string()?),
            Arg::Long("listen") => options.listen = Some(parser.value()?.string()?),
            Arg::Long("token") => options.token = Some(token(parser.value()?.string()?)?),
            Arg::Long("read-only") => options.is_read_only = true,
            Arg::Long("peer") => options.peers.push(peer(&parser.value()?.string()?)?),
            Arg::Long("web-root") => options.web_root = Some(parser.value()?.into()),
            Arg::Long("run-folder") => run_folder = Some(parser.value()?.into()),
            Arg::Long("runs") => runs = parser.value()?.into(),
            Arg::Long("record") => options.record = record(parser.value()?),
            Arg::Long("record-output") => options.record_outputs.push(parser.value()?.string()?),
            Arg::Long("recording-budget") => {
                options.recording_budget = Some(size(&parser.value()?.string()?)?);
            }
            Arg::Long("real-time") => options.is_real_time = true,
            Arg::Long("help") | Arg::Short('h') => return Ok(Command::Help),
            Arg::Long(other) => {
                let other = other.to_owned();
                if !options.replay.take(&other, &mut parser)? {
                    return Err(Arg::Long(&other).unexpected().into());
                }
            }
            unexpected => return Err(unexpected.unexpected().into()),
        }
    }
    options.run_folder = run_folder.unwrap_or_else(|| super::run_folder(&runs));
    options.is_replay = options.replay.is_asked(!options.settings.is_empty())?;
    if let (Some(_), Record::Into(path)) = (&options.scenario, &options.record) {
        let path = path.display();
        return Err(Error::new(format!(
            "--record {path}: a scenario may be played several times and names its recordings itself: say `--record on`, \
             and with `--run-folder DIR` where they shall lie"
        )));
    }
    Ok(Command::Run(Box::new(options)))
}

fn format_named(name: &str) -> Result<Format> {
    match name {
        "text" => Ok(Format::Text),
        "json" => Ok(Format::Json),
        _ => Err(Error::new(format!(
            "no format `{name}`: expected text or json"
        ))),
    }
}

fn token(written: String) -> Result<String> {
    match written.is_empty() {
        // Mostly a variable that is not set, of somebody who wants to be safe.
        true => Err(Error::new(
            "--token: it is empty, and nobody has to know an empty one: say another, or leave `--token` out, and then nobody \
             from other machines may change anything",
        )),
        false => Ok(written),
    }
}

fn record(written: OsString) -> Record {
    match written.to_str() {
        Some("on") => Record::On,
        Some("off") => Record::Off,
        _ => Record::Into(written.into()),
    }
}

fn setting(text: &str) -> Result<(String, String)> {
    let parts = text
        .split_once('=')
        .map(|(path, value)| (path.trim(), value.trim()));
    match parts {
        Some((path, value)) if path.split('.').all(|key| !key.is_empty()) => {
            Ok((path.to_owned(), value.to_owned()))
        }
        _ => Err(Error::new(format!("--set {text}: expected a.b=value"))),
    }
}

/// Where another robot serves its page, also as its program prints it (`http://10.1.24.22:4857/`).
///
/// It becomes part of the page's content security policy: nothing that means something there may stand in it, and it has
/// no words for addresses of IPv6 (CSP Level 3, `host-source`), which browsers therefore do not reach.
fn peer(text: &str) -> Result<String> {
    let address = text.strip_prefix("http://").unwrap_or(text);
    let address = address.strip_suffix('/').unwrap_or(address);
    let parts = address.rsplit_once(':').and_then(|(host, port)| {
        let is_letter = |byte: u8| byte.is_ascii_alphanumeric() || b"-.".contains(&byte);
        let is_host = !host.is_empty() && host.bytes().all(is_letter);
        let is_number = port.bytes().all(|byte| byte.is_ascii_digit());
        let port = port.parse::<u16>().ok().filter(|port| *port > 0)?;
        (is_host && is_number).then_some((host, port))
    });
    let Some((host, port)) = parts else {
        return Err(Error::new(format!(
            "--peer {text}: expected host and port of another robot's page, e.g. 10.1.24.22:4857 or nao22.local:4857; \
             browsers let no page ask an address of IPv6 that it names"
        )));
    };
    Ok(format!("{}:{port}", host.to_ascii_lowercase()))
}

fn text(argument: OsString) -> Result<String> {
    argument
        .into_string()
        .map_err(|argument| Error::new(format!("{} is no valid text", argument.display())))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(arguments: &[&str]) -> Result<Options> {
        match parse(arguments.iter().map(OsString::from))? {
            Command::Run(options) => Ok(*options),
            Command::Help => Err(Error::new("help")),
        }
    }

    #[test]
    fn every_option_is_understood_and_the_rest_is_the_hardwares() {
        let options = parsed(&[
            "--for",
            "1.5s",
            "--headless",
            "--check-parameters",
            "--format=json",
            "--parameters",
            "here",
            "--location",
            "lab",
            "--set",
            "a.b=[1, 2]",
            "--set",
            "c = x=y",
            "--run-folder",
            "there",
            "--record",
            "on",
            "--record-output",
            "Control.main_outputs.steps",
            "--recording-budget",
            "3MiB",
            "--replay=old",
            "--node=walk",
            "--real-time",
            "--scenario",
            "s.toml",
            "--seed=7",
            "--repeat",
            "3",
            "--threads=2",
            "--digests",
            "--tool=lens",
            "--listen",
            "0.0.0.0:1",
            "--token=secret",
            "--read-only",
            "--peer=http://NAO22.local:4857/",
            "--web-root=dist",
            "--",
            "--for",
            "lamp",
        ]);
        let expected = Options {
            duration: Some(Duration::from_millis(1500)),
            format: Format::Json,
            check_parameters: true,
            parameters: Some("here".into()),
            location: Some("lab".to_owned()),
            settings: vec![
                ("a.b".to_owned(), "[1, 2]".to_owned()),
                ("c".to_owned(), "x=y".to_owned()),
            ],
            run_folder: "there".into(),
            record: Record::On,
            record_outputs: vec!["Control.main_outputs.steps".to_owned()],
            recording_budget: Some(3 << 20),
            is_replay: true,
            replay: Replaying {
                file: "old".into(),
                node: Some("walk".to_owned()),
                ..Replaying::default()
            },
            is_real_time: true,
            scenario: Some("s.toml".into()),
            seed: Some(7),
            repeat: Some(3),
            threads: Some(2),
            digests: true,
            tool: Some("lens".to_owned()),
            listen: Some("0.0.0.0:1".to_owned()),
            token: Some("secret".to_owned()),
            is_read_only: true,
            peers: vec!["nao22.local:4857".to_owned()],
            web_root: Some("dist".into()),
            hardware: vec!["--for".to_owned(), "lamp".to_owned()],
        };
        assert_eq!(options.expect("all options are valid"), expected);
    }

    #[test]
    fn a_peer_is_one_host_with_a_port_and_nothing_else() {
        for wrong in [
            "",
            "*",
            ":1",
            "a",
            "a:",
            "a:0",
            "a:+1",
            "a:65536",
            "*:1",
            "a:*",
            "*.a:1",
            "a b:1",
            "a;b:1",
            "a'b:1",
            "a/b:1",
            "a:1/b",
            "https://a:1",
            "ws://a:1",
            "a:1:2",
            "::1:2",
            "[::1]",
            "[::1]:4858",
            "[a]:1",
            "a,b:1",
            "u@a:1",
        ] {
            assert!(peer(wrong).is_err(), "{wrong}");
        }
        for (written, expected) in [
            ("10.1.24.22:4857", "10.1.24.22:4857"),
            ("http://127.0.0.1:4858/", "127.0.0.1:4858"),
            ("a:04857", "a:4857"),
            ("Nao22.Local:80", "nao22.local:80"),
        ] {
            assert_eq!(peer(written).expect(written), expected);
        }
    }

    #[test]
    fn a_run_has_a_folder_of_its_own_among_the_others() {
        let folder = |words: &[&str]| parsed(words).map(|options| options.run_folder);
        for (words, runs) in [
            (&[][..], "runs"),
            (&["--runs", "/robot/runs"], "/robot/runs"),
        ] {
            let folder = folder(words).expect("it is right usage");
            assert_eq!(folder.parent(), Some(runs.as_ref()), "{words:?}");
        }
        let chosen = folder(&["--run-folder=here", "--runs=there"]);
        assert_eq!(chosen.expect("it is right usage"), PathBuf::from("here"));
    }

    #[test]
    fn a_tolerance_of_nothing_is_one_that_was_asked_for() {
        let tolerance = |word| {
            let options = parsed(&["--replay=old", "--verify", word]);
            options.expect(word).replay.tolerance
        };
        assert_eq!(tolerance("--headless"), None);
        assert_eq!(tolerance("--tolerance=0"), Some(0.0));
        assert_eq!(tolerance("--tolerance=1e-3"), Some(1e-3));
    }

    #[test]
    fn wrong_usage_is_an_error() {
        for wrong in [
            &["--fro", "1s"][..],
            &["--set", "a"],
            &["--set", ".a=1"],
            &["x"],
            &["--format", "xml"],
            &["--for"],
            &["--verify"],
            &["--node", "walk"],
            &["--replay=old", "--verify", "--set", "a=1"],
            &["--replay=old", "--against=other", "--tolerance=1e-6"],
            &["--replay=old", "--verify", "--carry"],
            &["--set", "a=1", "--carry"],
            &["--replay=old", "--verify", "--tolerance=-1"],
            &["--recording-budget", "2"],
            &["--scenario=s.toml", "--record=tape"],
            &["--token", ""],
            &["--token="],
        ] {
            assert!(parsed(wrong).is_err(), "{wrong:?}");
        }
    }
}
