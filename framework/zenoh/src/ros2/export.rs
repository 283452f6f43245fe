//! The messages of a robot, for those who build their nodes of ROS 2 with them.

use std::path::Path;

use client::Robot;

use super::interface::{self, Interface};
use super::key::Key;
use super::packages::Packages;
use crate::Result;
use crate::edges::{self, Edge, Encoding};
use crate::forms::Form;

/// Writes packages for all that the robot maps as CDR, and prints its keys with their hashes. What ROS 2 cannot have is told
/// and left out.
///
/// # Errors
/// If the robot does not answer, or a package cannot be written.
pub(crate) fn export(robot: &mut Robot, folder: &Path) -> Result<()> {
    let mut packages = Packages::default();
    for edge in edges::of_robot(robot)? {
        if edge.encoding != Encoding::Cdr {
            continue;
        }
        match describe(robot, &edge) {
            Ok((key, interface)) => {
                packages.add(&edge.path, &key, &interface)?;
                println!(
                    "{}\nkey = \"{}\"",
                    edge.path,
                    key.with_hash(&interface.hash())
                );
            }
            Err(message) => eprintln!("warning: `{}`: {message}", edge.path),
        }
    }
    let names = packages.write(folder, &robot.welcome.robot)?;
    for name in names {
        eprintln!("wrote {}", folder.join(name).display());
    }
    Ok(())
}

fn describe(robot: &mut Robot, edge: &Edge) -> Result<(Key, Interface)> {
    let key = interface::key(edge).ok_or_else(|| {
        let group = interface::group(edge).folder();
        format!(
            "`{}` is no key of ROS 2: write `DOMAIN/NAME/PACKAGE::{group}::dds_::TYPE_/HASH`, for example with the hash `0`",
            edge.key
        )
    })?;
    let form = Form::ask(robot, edge)?;
    let interface = Interface::new(&key, &form)?;
    Ok((key, interface))
}
