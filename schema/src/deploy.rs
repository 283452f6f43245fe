//! How the program of a target gets onto its robots.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How the program of a target gets onto its robots, and how it is started there.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Deploy {
    /// Folder on the robot for versions and runs, from its root: `/home/nao/robot`.
    pub folder: String,
    /// Robots by name, each with its destination for ssh: `{ nao22 = "nao@10.1.24.22" }`.
    #[serde(default)]
    pub hosts: BTreeMap<String, String>,
    /// Configuration of ssh with keys and options, relative to the workspace root. Left out: the user's own.
    #[serde(default)]
    pub ssh_config: Option<String>,
    /// Files and folders in the workspace that the program reads besides its parameters, relative to its root.
    #[serde(default)]
    pub files: Vec<String>,
    /// Unit file of systemd in the workspace, relative to its root; it starts `<folder>/current/start`. Left out: nothing is started.
    #[serde(default)]
    pub unit: Option<String>,
    /// What manages the unit on the robot. Left out: `systemctl --user`.
    #[serde(default = "systemctl")]
    pub systemctl: String,
    /// What prints the unit's log on the robot. Left out: `journalctl --user`.
    #[serde(default = "journalctl")]
    pub journalctl: String,
    /// What joins a wireless network on the robot, its name as one quoted word in place of `{name}`: `nmcli connection up {name}`.
    #[serde(default)]
    pub wlan: Option<String>,
}

fn systemctl() -> String {
    "systemctl --user".to_owned()
}

fn journalctl() -> String {
    "journalctl --user".to_owned()
}
