//! Which robots are meant, and how they are reached: the manifest's `[target.deploy]` and the command line.

use camino::Utf8PathBuf;

use crate::arguments;
use crate::commands::Failure;
use crate::commands::session::Session;
use crate::deploy::script::Service;
use crate::deploy::{Destination, Remote};
use crate::diagnostics::{listed, nearest};
use crate::manifest;
use crate::outcome::Refusal;

/// How robots of one target are reached.
pub(in crate::commands) struct Reached {
    pub(super) target: schema::Target,
    pub(super) deploy: schema::Deploy,
    pub(super) parameters: Utf8PathBuf,
    ssh_config: Option<Utf8PathBuf>,
}

/// One of them.
pub(super) struct Robot {
    pub(super) remote: Remote,
}

impl Reached {
    /// What manifest and command line say; nodes are not looked at.
    pub(super) fn read(
        session: &mut Session<'_>,
        reached: &arguments::Reached,
    ) -> Result<Self, Failure> {
        let manifest = manifest::load(&session.workspace, &mut session.diagnostics)?;
        let target = choose(&manifest, reached.target.as_deref())?;
        let deploy = target.deploy.clone().ok_or_else(|| {
            Refusal::wrong_usage(format!("hulk.toml does not say how `{}` gets onto robots", target.name.as_str()))
                .help("add `[target.deploy]` with `folder` and `hosts` below the target: docs/guides/deploy.md")
        })?;
        let root = session.workspace.root();
        let of_manifest = deploy.ssh_config.as_deref().map(|file| root.join(file));
        Ok(Self {
            target: target.clone(),
            parameters: manifest.robot.parameters.clone(),
            ssh_config: reached.ssh_config.clone().or(of_manifest),
            deploy,
        })
    }

    /// The robots of these names or destinations.
    pub(super) fn robots(&self, hosts: &[String]) -> Result<Vec<Robot>, Refusal> {
        let mut robots: Vec<Robot> = Vec::new();
        for host in hosts {
            if robots.iter().any(|robot| &robot.remote.name == host) {
                return Err(Refusal::wrong_usage(format!("`{host}` is named twice")));
            }
            robots.push(self.robot(host)?);
        }
        Ok(robots)
    }

    /// As [`Self::robots`], each of them once: two deeds at once would be in each other's way there.
    pub(super) fn different_robots(&self, hosts: &[String]) -> Result<Vec<Robot>, Refusal> {
        let robots = self.robots(hosts)?;
        for (index, Robot { remote }) in robots.iter().enumerate() {
            let earlier = robots[..index].iter().map(|robot| &robot.remote);
            let same = |other: &&Remote| remote.destination.is_machine_of(&other.destination);
            if let Some(other) = earlier.into_iter().find(same) {
                let message = format!("`{}` and `{}` are one robot", other.name, remote.name);
                return Err(Refusal::wrong_usage(message).help("name it once"));
            }
        }
        Ok(robots)
    }

    /// Of a name among `hosts`, else a destination: it has an `@`, a dot or a colon.
    pub(super) fn robot(&self, host: &str) -> Result<Robot, Refusal> {
        let known = self.deploy.hosts.get(host);
        let is_destination = host.contains(['@', '.', ':']) && !host.starts_with('-');
        if known.is_none() && !is_destination {
            let names = || self.deploy.hosts.keys().map(String::as_str);
            let list = format!(
                "`hosts` of `[target.deploy]` has {}; a destination for ssh has an `@` or a dot",
                listed(names())
            );
            return Err(
                Refusal::wrong_usage(format!("there is no robot `{host}`")).help(
                    match nearest(host, names()) {
                        Some(nearest) => format!("did you mean `{nearest}`? {list}"),
                        None => list,
                    },
                ),
            );
        }
        let written = known.map_or(host, String::as_str);
        let destination = Destination::parse(written).ok_or_else(|| {
            Refusal::wrong_usage(format!("`{written}` is no destination for ssh"))
                .help(Destination::HELP)
        })?;
        Ok(Robot {
            remote: Remote {
                name: host.to_owned(),
                destination,
                ssh_config: self.ssh_config.clone(),
            },
        })
    }

    /// Where everything is on the robot.
    pub(in crate::commands) fn folder(&self) -> &str {
        &self.deploy.folder
    }

    /// What programs of the target are built for; `None`: the machine of the developer.
    pub(in crate::commands) fn triple(&self) -> Option<&str> {
        self.target.triple.as_deref()
    }

    /// Whether the programs of a user's own systemd are started there.
    pub(in crate::commands) fn is_of_a_user(&self) -> bool {
        let mut words = self.deploy.systemctl.split_whitespace();
        self.deploy.unit.is_some() && words.any(|word| word == "--user")
    }

    /// Of the unit there are a name and what manages it.
    pub(super) fn service(&self) -> Service<'_> {
        service(&self.deploy)
    }
}

/// One robot and its folder, for other commands.
pub(in crate::commands) fn remote(
    session: &mut Session<'_>,
    host: &str,
    reached: &arguments::Reached,
) -> Result<(Remote, Reached), Failure> {
    let reached = Reached::read(session, reached)?;
    let remote = reached.robot(host)?.remote;
    Ok((remote, reached))
}

/// The unit is called as its file.
pub(super) fn service(deploy: &schema::Deploy) -> Service<'_> {
    let unit = deploy.unit.as_deref();
    Service {
        unit: unit.map(|file| file.rsplit('/').next().unwrap_or(file)),
        systemctl: &deploy.systemctl,
    }
}

/// The target of this name, else the first that says how it gets onto robots.
fn choose<'m>(
    manifest: &'m manifest::Manifest,
    name: Option<&str>,
) -> Result<&'m schema::Target, Refusal> {
    let mut targets = manifest.targets.iter().map(|target| &target.declared);
    let names = || {
        manifest
            .targets
            .iter()
            .map(|target| target.declared.name.as_str())
    };
    match name {
        Some(name) => targets.find(|target| target.name.as_str() == name).ok_or_else(|| {
            Refusal::wrong_usage(format!("there is no target `{name}`"))
                .help(format!("the targets are {}", listed(names())))
        }),
        None => targets.find(|target| target.deploy.is_some()).ok_or_else(|| {
            Refusal::wrong_usage("hulk.toml does not say how a target gets onto robots")
                .help("add `[target.deploy]` with `folder` and `hosts` below a target: docs/guides/deploy.md")
        }),
    }
}
