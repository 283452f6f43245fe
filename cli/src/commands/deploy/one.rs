//! One robot's part of `deploy`.

use super::reached::service;
use crate::deploy::script::{self, quoted};
use crate::deploy::{Failed, Fit, ForRobot, Package, Remote};
use crate::outcome::Refusal;

/// Where the reason stands.
const LOGS: &str = "`hulkgen logs` shows what it said";

/// What is to be done on one robot.
pub(super) struct Deed<'a> {
    pub(super) remote: &'a Remote,
    pub(super) deploy: &'a schema::Deploy,
    /// `None`: the version before is wanted.
    pub(super) package: Option<(&'a Package, ForRobot)>,
    pub(super) discards_changes: bool,
    pub(super) wlan: Option<&'a str>,
}

/// How it is there now.
pub(super) struct Done {
    pub(super) version: String,
    pub(super) before: Option<String>,
    /// "runs", as it was seen to for some seconds; or "is there" where nothing starts it.
    pub(super) state: &'static str,
}

/// What a robot said of itself.
#[derive(Debug, Default, PartialEq, Eq)]
struct Probed {
    machine: String,
    kibibytes: Option<u64>,
    has_rsync: bool,
    /// The folder of the current version there.
    current: Option<String>,
    /// After a rollback: that of the version that was current.
    previous: Option<String>,
    /// Files of the current version that were changed there.
    changed: Vec<String>,
    /// Files of it that were removed there.
    gone: Vec<String>,
}

impl Deed<'_> {
    /// All of it; the robot runs what it ran if something fails.
    pub(super) fn execute(&self, say: &mut dyn FnMut(String)) -> Result<Done, Refusal> {
        let mut done = match &self.package {
            Some((package, for_robot)) => self.put(package, for_robot, say)?,
            None => self.roll_back(say)?,
        };
        if let (Some(name), Some(command)) = (self.wlan, &self.deploy.wlan) {
            say(format!("joining `{name}`"));
            let joined = self.remote.shell(&command.replace("{name}", &quoted(name)));
            joined.map_err(|failed| {
                Refusal::bad(format!(
                    "{} is there, but it did not join `{name}`: {}",
                    done.version, failed.message
                ))
            })?;
        }
        if self.deploy.unit.is_some() {
            done.state = "runs";
        }
        Ok(done)
    }

    fn put(
        &self,
        package: &Package,
        for_robot: &ForRobot,
        say: &mut dyn FnMut(String),
    ) -> Result<Done, Refusal> {
        let folder = &self.deploy.folder;
        let probed = self.remote.shell(&script::probe(folder));
        let probed = Probed::read(&probed.map_err(|failed| not_reached(self.remote, &failed))?);
        probed.permits(package, self)?;
        say(match probed.version() {
            Some(current) => format!("runs {current}; sending {} KiB", package.kibibytes),
            None => format!("has no version yet; sending {} KiB", package.kibibytes),
        });
        let mut told = 0;
        let sent = self.remote.send(
            &for_robot.folder()?,
            &format!("{folder}/versions/.incoming"),
            probed.current.as_deref(),
            |percent| {
                if percent >= told + 20 {
                    told = percent;
                    say(format!("{percent} % sent"));
                }
            },
        );
        sent.map_err(|failed| not_sent(&failed))?;
        say(format!("switching to {}", package.version));
        let switched = self.remote.shell(&script::switch(
            folder,
            &package.version,
            service(self.deploy),
        ));
        switched.map_err(|failed| not_switched(&failed, &probed))?;
        Ok(Done {
            version: package.version.clone(),
            before: probed.version().map(str::to_owned),
            state: "is there",
        })
    }

    fn roll_back(&self, say: &mut dyn FnMut(String)) -> Result<Done, Refusal> {
        let script = script::roll_back(&self.deploy.folder, service(self.deploy));
        let said = self
            .remote
            .shell(&script)
            .map_err(|failed| match failed.status {
                Some(3) => Refusal::bad(format!(
                    "the version before did not start, the one that ran runs again: {}",
                    failed.message
                ))
                .help(LOGS),
                Some(4) => Refusal::bad(format!(
                    "the version before did not start, nor does the one that ran, which is current again: {}",
                    failed.message
                ))
                .help(LOGS),
                _ if failed.is_unreachable() => not_reached(self.remote, &failed),
                _ => failed.into(),
            })?;
        let probed = Probed::read(&said);
        if let Some(differs) = probed.differs() {
            let left = name_of(probed.previous.as_deref()).unwrap_or_default();
            say(format!(
                "warning: {differs} in {left}, which does not count now; another `--rollback` goes back to it"
            ));
        }
        Ok(Done {
            version: probed.version().unwrap_or_default().to_owned(),
            before: None,
            state: "is there",
        })
    }
}

impl Probed {
    /// Lines of a word and a value; others are what a login prints.
    fn read(said: &str) -> Self {
        let mut probed = Self::default();
        for line in said.lines() {
            let Some((word, value)) = line.split_once(' ') else {
                continue;
            };
            let value = value.trim();
            let file = || value.trim_start_matches("./").to_owned();
            match word {
                "machine" => probed.machine = value.to_owned(),
                "free" => probed.kibibytes = value.parse().ok(),
                "rsync" => probed.has_rsync = true,
                "current" => probed.current = Some(value.to_owned()),
                "previous" => probed.previous = Some(value.to_owned()),
                "changed" => probed.changed.push(file()),
                "gone" => probed.gone.push(file()),
                _ => {}
            }
        }
        probed
    }

    /// What runs there: versions are called as their folders.
    fn version(&self) -> Option<&str> {
        name_of(self.current.as_deref())
    }

    /// What somebody did to files there: of each deed the first file, and how many more; `None`: nothing.
    fn differs(&self) -> Option<String> {
        let deed = |files: &[String], deed: &str| {
            let first = files.first()?;
            Some(match files.len() - 1 {
                0 => format!("`{first}` was {deed}"),
                more => format!("`{first}` and {more} more were {deed}"),
            })
        };
        let deeds = [deed(&self.changed, "changed"), deed(&self.gone, "removed")];
        let deeds: Vec<String> = deeds.into_iter().flatten().collect();
        (!deeds.is_empty()).then(|| deeds.join(", "))
    }

    fn permits(&self, package: &Package, deed: &Deed<'_>) -> Result<(), Refusal> {
        let machine = self.machine.as_str();
        // Whether the system has libraries for a smaller machine's programs shows when it starts there.
        if package.machine.fit(machine) == Fit::Fails {
            let built = package.machine.name();
            return Err(Refusal::bad(format!(
                "the program is for {built}, the robot is {machine}"
            ))
            .help("build for the robot's machine: `triple` of the target in hulk.toml"));
        }
        if !self.has_rsync {
            return Err(Refusal::bad("the robot has no rsync").help("install rsync there"));
        }
        if let Some(free) = self.kibibytes
            && free < package.kibibytes
        {
            let message = format!(
                "no space left: {} KiB are needed, {free} KiB are free",
                package.kibibytes
            );
            return Err(
                Refusal::bad(message).help("fetch and remove old runs: `hulkgen recording pull`")
            );
        }
        if let Some(differs) = self.differs()
            && !deed.discards_changes
        {
            let message = format!("{differs} on the robot, which would be lost");
            return Err(Refusal::bad(message).help(match self.changed.is_empty() {
                true => "remove it here, too, or let it come back; then give `--discard-changes`".to_owned(),
                false => format!(
                    "bring it home with `{}`, here in the robot's folder; then give `--discard-changes`",
                    self.fetching(deed)
                ),
            }));
        }
        Ok(())
    }

    /// What a person types to get the changed files, each into its folder.
    fn fetching(&self, deed: &Deed<'_>) -> String {
        let folder = &deed.deploy.folder;
        let files = self.changed.iter();
        let files = files.map(|file| format!("{folder}/current/./{file}"));
        deed.remote.fetching_as_typed(files)
    }
}

/// A version's name: that of its folder.
fn name_of(folder: Option<&str>) -> Option<&str> {
    folder?.rsplit('/').next()
}

/// ssh gave up.
fn not_reached(remote: &Remote, failed: &Failed) -> Refusal {
    if !failed.is_unreachable() {
        return Refusal::bad(failed.message.clone());
    }
    Refusal::bad(format!("not reached: {}", failed.message)).help(format!(
        "try `{}`: network, key, and the host's key",
        remote.as_typed()
    ))
}

fn not_sent(failed: &Failed) -> Refusal {
    if failed.is_full() {
        return Refusal::bad("no space left on the robot; it runs what it ran before")
            .help("fetch and remove old runs: `hulkgen recording pull`");
    }
    if failed.is_unreachable() {
        return Refusal::bad(format!(
            "the connection broke; the robot runs what it ran before: {}",
            failed.message
        ))
        .help("deploy again: what has arrived is not sent again");
    }
    Refusal::bad(failed.message.clone())
}

fn not_switched(failed: &Failed, probed: &Probed) -> Refusal {
    let message = match (failed.status, probed.version()) {
        (Some(3), Some(current)) => format!(
            "the new version did not start, {current} runs again: {}",
            failed.message
        ),
        (Some(4), Some(current)) => format!(
            "the new version did not start, nor does {current}, which is current again: {}",
            failed.message
        ),
        (Some(3 | 4), None) => format!("the new version did not start: {}", failed.message),
        (Some(255), _) => format!("the connection broke while switching: {}", failed.message),
        _ => failed.message.clone(),
    };
    match failed.status {
        Some(255) => Refusal::bad(message).help("`hulkgen robots` shows which version runs"),
        Some(3 | 4) => Refusal::bad(message).help(LOGS),
        _ => Refusal::bad(message),
    }
}

#[cfg(test)]
mod tests {
    use super::Probed;

    #[test]
    fn a_probe_is_read_whatever_a_login_prints() {
        let said = "Welcome!\nmachine x86_64\nfree 1024\nrsync yes\ncurrent /home/nao/robot/versions/2026\nchanged ./a/b.toml\ngone ./a/c.toml\n";
        let expected = Probed {
            machine: "x86_64".to_owned(),
            kibibytes: Some(1024),
            has_rsync: true,
            current: Some("/home/nao/robot/versions/2026".to_owned()),
            previous: None,
            changed: vec!["a/b.toml".to_owned()],
            gone: vec!["a/c.toml".to_owned()],
        };
        assert_eq!(expected.version(), Some("2026"));
        assert_eq!(
            expected.differs().as_deref(),
            Some("`a/b.toml` was changed, `a/c.toml` was removed")
        );
        assert_eq!(Probed::read(said), expected);
        assert_eq!(Probed::read("free ?\n").kibibytes, None);
    }
}
