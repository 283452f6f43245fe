//! What targets say of machines, robots and files, as far as it can be told here: else it shows when a program is built, or
//! on the robot.

use std::ops::Range;

use camino::{Utf8Component, Utf8Path};

use super::{Manifest, Target, without_dots};
use crate::cross::{Wanted, WrongTriple};
use crate::deploy::{BESIDE, Destination};
use crate::diagnostics::{Code, Diagnostic, Diagnostics, nearest};
use crate::workspace::{MANIFEST, Workspace};

pub(super) fn check(workspace: &Workspace, manifest: &Manifest, diagnostics: &mut Diagnostics) {
    for target in &manifest.targets {
        check_triple(target, diagnostics);
        check_profile(workspace, target, diagnostics);
        if let Some(deploy) = &target.declared.deploy {
            let said = Said { deploy, target };
            said.check_words(diagnostics);
            said.check_hosts(diagnostics);
            said.check_ways(diagnostics);
            said.check_names(manifest, diagnostics);
            said.check_files(workspace, diagnostics);
        }
    }
    // Every robot gets them.
    let parameters = manifest.robot.parameters.as_str();
    let mut targets = manifest.targets.iter();
    if targets.any(|target| target.declared.deploy.is_some()) && !is_below(parameters) {
        diagnostics.add(elsewhere(parameters, &manifest.parameters_range));
    }
}

/// Files of `[target.deploy]` that are to be sent and are not there, each with the key that names it.
pub fn absent_files<'d>(
    workspace: &Workspace,
    deploy: &'d schema::Deploy,
) -> Vec<(&'static str, &'d str)> {
    let files = deploy.files.iter().map(|file| ("files", file.as_str()));
    let unit = deploy.unit.iter().map(|file| ("unit", file.as_str()));
    let is_there = |(key, file): &(&str, &str)| {
        let file = without_dots(Utf8Path::new(file));
        workspace.is_file(&file) || *key == "files" && is_folder(workspace, &file)
    };
    files.chain(unit).filter(|one| !is_there(one)).collect()
}

/// Whether it is among what the folder above it holds: an empty folder can be sent, too.
fn is_folder(workspace: &Workspace, folder: &Utf8Path) -> bool {
    match folder.parent() {
        Some(above) => workspace.list(above).iter().any(|entry| entry == folder),
        // The workspace itself.
        None => true,
    }
}

/// An error or a warning in the manifest.
fn mistake(code: Code, message: String, range: &Range<usize>, label: &str) -> Diagnostic {
    Diagnostic::new(code, message).at(Utf8Path::new(MANIFEST), range.clone(), label)
}

fn check_triple(target: &Target, diagnostics: &mut Diagnostics) {
    let (Some(triple), Some(range)) = (&target.declared.triple, &target.triple_range) else {
        return;
    };
    if let Err(wrong) = Wanted::parse(triple) {
        let error = mistake(Code::InvalidValue, wrong.to_string(), range, "");
        diagnostics.add(error.help(WrongTriple::HELP));
    }
}

/// A warning: the environment, too, can tell cargo of a profile.
fn check_profile(workspace: &Workspace, target: &Target, diagnostics: &mut Diagnostics) {
    let (Some(profile), Some(range)) = (&target.declared.profile, &target.profile_range) else {
        return;
    };
    let Some(known) = workspace.profiles() else {
        return;
    };
    if known.contains(profile) {
        return;
    }
    let message = format!("Cargo.toml has no profile `{profile}`");
    let label = "cargo refuses to build this target";
    let warning = mistake(Code::UnknownProfile, message, range, label);
    diagnostics.add(
        warning.help(match nearest(profile, known.iter().map(String::as_str)) {
            Some(near) => format!("did you mean `{near}`?"),
            None => {
                format!("add `[profile.{profile}]` with `inherits = \"release\"` to Cargo.toml")
            }
        }),
    );
}

/// A target's `[target.deploy]`.
struct Said<'m> {
    deploy: &'m schema::Deploy,
    target: &'m Target,
}

impl Said<'_> {
    /// Of a value that is there.
    fn range(&self, key: &str) -> &Range<usize> {
        let own = self.target.deploy_ranges.values.get(key);
        own.unwrap_or(&self.target.name_range)
    }

    fn wrong(&self, key: &str, message: String) -> Diagnostic {
        mistake(Code::InvalidValue, message, self.range(key), "")
    }

    fn check_words(&self, diagnostics: &mut Diagnostics) {
        let deploy = self.deploy;
        if !deploy.folder.starts_with('/') {
            let message = format!(
                "`{}` is no whole path: a robot's folder is the same from wherever one looks",
                deploy.folder
            );
            let error = self.wrong("folder", message);
            diagnostics.add(error.help(match deploy.folder.starts_with('~') {
                true => "write what `~` stands for on the robot: no shell replaces it here",
                false => "begin it with `/`, as in `/home/nao/robot`",
            }));
        }
        if deploy
            .wlan
            .as_ref()
            .is_some_and(|it| !it.contains("{name}"))
        {
            let message = "`wlan` does not say where the network's name goes: it would join the same one whatever `--wlan` names";
            let error = self.wrong("wlan", message.to_owned());
            diagnostics
                .add(error.help("write `{name}` in its place, as in `nmcli connection up {name}`"));
        }
        if deploy.wlan.as_deref().is_some_and(quotes_the_name) {
            let message = "`{name}` stands in quotes of its own: it is replaced by one quoted word, and these quotes would be part of the network's name";
            let error = self.wrong("wlan", message.to_owned());
            diagnostics.add(error.help(
                "leave the quotes out, as in `nmcli connection up {name}`; where the program wants some, end yours before it, as in `'\"'{name}'\"'`",
            ));
        }
        for (key, command) in [
            ("systemctl", &deploy.systemctl),
            ("journalctl", &deploy.journalctl),
        ] {
            if command.trim().is_empty() {
                let error = self.wrong(key, format!("`{key}` is no command"));
                diagnostics.add(error.help(format!("leave it out for `{key} --user`")));
            }
        }
    }

    fn check_hosts(&self, diagnostics: &mut Diagnostics) {
        for (name, destination) in &self.deploy.hosts {
            if Destination::parse(destination).is_none() {
                let ranges = &self.target.deploy_ranges.hosts;
                let range = ranges.get(name).unwrap_or(&self.target.name_range);
                let message = format!("`{destination}` is no destination for ssh");
                let error = mistake(Code::InvalidValue, message, range, "");
                diagnostics.add(error.help(Destination::HELP));
            }
        }
    }

    /// What is sent keeps its folders, so that nothing from elsewhere has a place there; a unit would even be moved away.
    fn check_ways(&self, diagnostics: &mut Diagnostics) {
        let files = self.deploy.files.iter().map(String::as_str);
        let files = files.zip(&self.target.deploy_ranges.files);
        let unit = self.deploy.unit.as_deref();
        let unit = unit.map(|unit| (unit, self.range("unit")));
        for (file, range) in files.chain(unit) {
            if !is_below(file) {
                diagnostics.add(elsewhere(file, range));
            }
        }
    }

    /// The program lies beside all that is sent with it.
    fn check_names(&self, manifest: &Manifest, diagnostics: &mut Diagnostics) {
        let name = self.target.declared.name.as_str();
        let of_deploy = BESIDE.contains(&name);
        let files = self.deploy.files.iter().map(String::as_str);
        let ways = files.chain([manifest.robot.parameters.as_str()]);
        let unit = self.deploy.unit.as_deref();
        let file = unit.and_then(|unit| Utf8Path::new(unit).file_name());
        let is_sent = ways
            .chain(unit)
            .map(first_of)
            .chain([file])
            .flatten()
            .any(|it| it == name);
        if of_deploy || is_sent {
            let what = if of_deploy {
                "`hulkgen deploy` puts one there"
            } else {
                "it is sent, too"
            };
            let message = format!(
                "the program `{name}` would lie in the place of another `{name}` on a robot: {what}"
            );
            let range = &self.target.name_range;
            let error = mistake(Code::InvalidValue, message, range, "");
            diagnostics.add(error.help("give the target another name"));
        }
    }

    fn check_files(&self, workspace: &Workspace, diagnostics: &mut Diagnostics) {
        for (key, file) in absent_files(workspace, self.deploy) {
            let places = self
                .deploy
                .files
                .iter()
                .zip(&self.target.deploy_ranges.files);
            let place = places.into_iter().find(|(other, _)| *other == file);
            let range = match (key, place) {
                ("files", Some((_, range))) => range,
                _ => self.range(key),
            };
            if is_below(file) {
                let label = "`hulkgen deploy` refuses without it";
                diagnostics.add(missing(workspace, file, range, label));
            }
        }
        if let Some(file) = &self.deploy.ssh_config
            && !workspace.is_file(&without_dots(Utf8Path::new(file)))
        {
            let label = "ssh reaches no robot without it, unless `--ssh-config` names another";
            diagnostics.add(missing(workspace, file, self.range("ssh_config"), label));
        }
    }
}

/// What does not lie where it can be sent from.
fn elsewhere(file: &str, range: &Range<usize>) -> Diagnostic {
    let message = format!("`{file}` is no plain path below the workspace root");
    let label = "is sent with its folders";
    let error = mistake(Code::InvalidValue, message, range, label);
    error.help("copy it into the workspace, and name it from its root")
}

/// A warning: a build may make the file, and some lie where the robots are alone.
fn missing(workspace: &Workspace, file: &str, range: &Range<usize>, label: &str) -> Diagnostic {
    let message = format!("`{file}` is not there");
    let warning = mistake(Code::MissingFile, message, range, label);
    let path = without_dots(Utf8Path::new(file));
    let beside = workspace.list(path.parent().unwrap_or(Utf8Path::new("")));
    let names = beside.iter().filter_map(|entry| entry.file_name());
    let near = path.file_name().and_then(|name| nearest(name, names));
    warning.help(match near {
        Some(near) => format!("did you mean `{}`?", path.with_file_name(near)),
        None => format!("make `{file}`, or name what is there"),
    })
}

/// Whether `{name}` stands in quotes of its own. Between others, as in `sh -c "up {name}"`, another shell may take the word apart.
fn quotes_the_name(command: &str) -> bool {
    let mut quote = None;
    let mut is_escaped = false;
    for (index, one) in command.char_indices() {
        if is_escaped {
            is_escaped = false;
            continue;
        }
        match (one, quote) {
            ('\\', None | Some('"')) => is_escaped = true,
            ('"' | '\'', None) => {
                let rest = command[index + 1..].strip_prefix("{name}");
                if rest.is_some_and(|rest| rest.starts_with(one)) {
                    return true;
                }
                quote = Some(one);
            }
            (one, Some(open)) if one == open => quote = None,
            _ => {}
        }
    }
    false
}

/// The first folder of a way, or the file itself.
fn first_of(way: &str) -> Option<&str> {
    let mut parts = Utf8Path::new(way).components();
    parts.find_map(|part| match part {
        Utf8Component::Normal(name) => Some(name),
        _ => None,
    })
}

fn is_below(file: &str) -> bool {
    let is_plain = |part| matches!(part, Utf8Component::Normal(_) | Utf8Component::CurDir);
    !file.is_empty() && Utf8Path::new(file).components().all(is_plain)
}
