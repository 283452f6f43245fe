//! Packages of ROS 2 with the messages and services of the robot, ready for `colcon build`.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use super::interface::Interface;
use super::key::Key;
use super::messages::{Definition, Kind, Many, Message};
use super::service::Service;
use crate::Result;

/// Whoever writes over a package looks for it first.
const MARK: &str = "<!-- Written by hulkgen-zenoh --messages, which writes it anew. -->";

/// Packages that come with ROS 2: their messages are there.
const OF_ROS: &str = "\
action_msgs actionlib_msgs builtin_interfaces composition_interfaces diagnostic_msgs example_interfaces geometry_msgs \
lifecycle_msgs map_msgs nav_msgs pcl_msgs rcl_interfaces rosgraph_msgs sensor_msgs service_msgs shape_msgs \
statistics_msgs std_msgs std_srvs stereo_msgs test_msgs tf2_msgs trajectory_msgs type_description_interfaces \
unique_identifier_msgs visualization_msgs";

/// By name.
#[derive(Default)]
pub(crate) struct Packages(BTreeMap<String, Package>);

/// Files by their names, in the package's folder.
#[derive(Default)]
struct Package(BTreeMap<String, String>);

impl Packages {
    /// What carries the values of this path under this key.
    ///
    /// # Errors
    /// If another path has other fields for a message of that name.
    pub(crate) fn add(&mut self, path: &str, key: &Key, interface: &Interface) -> Result<()> {
        let is_of_ros = OF_ROS.split(' ').any(|package| package == key.package);
        if is_of_ros {
            return Ok(());
        }
        let package = self.0.entry(key.package.clone()).or_default();
        let name = &key.type_name;
        match interface {
            Interface::Message(Definition { root, nested }) => {
                for message in nested.iter().chain([root]) {
                    package.add_message(path, message)?;
                }
            }
            Interface::Service(Service {
                request, response, ..
            }) => {
                for message in request.nested.iter().chain(&response.nested) {
                    package.add_message(path, message)?;
                }
                let text = format!("{}---\n{}", text(&request.root), text(&response.root));
                package.add(path, format!("srv/{name}.srv"), text)?;
            }
        }
        Ok(())
    }

    /// Each in a folder of its name; gives their names.
    ///
    /// # Errors
    /// If one of them is there and somebody else's, or cannot be written.
    pub(crate) fn write(&self, folder: &Path, robot: &str) -> Result<Vec<&str>> {
        for (name, package) in &self.0 {
            package.write(name, &folder.join(name), robot)?;
        }
        Ok(self.0.keys().map(String::as_str).collect())
    }
}

impl Package {
    fn add_message(&mut self, path: &str, message: &Message) -> Result<()> {
        let name = message.name.rsplit('/').next().unwrap_or_default();
        self.add(path, format!("msg/{name}.msg"), text(message))
    }

    fn add(&mut self, path: &str, file: String, text: String) -> Result<()> {
        let mut names = self.0.iter();
        match names.find(|(name, _)| name.eq_ignore_ascii_case(&file)) {
            Some((name, known)) if *name != file || *known != text => Err(format!(
                "`{path}` and another path need different files {file}: give one of their keys another name of a message"
            )),
            _ => {
                self.0.insert(file, text);
                Ok(())
            }
        }
    }

    fn write(&self, name: &str, folder: &Path, robot: &str) -> Result<()> {
        let manifest = folder.join("package.xml");
        let is_ours = |text: String| text.contains(MARK);
        if folder.exists() && !fs::read_to_string(&manifest).is_ok_and(is_ours) {
            return Err(format!(
                "{} is there and not of `--messages`: name another folder, or remove it",
                folder.display()
            ));
        }
        let robot = robot.replace('&', "&amp;").replace('<', "&lt;");
        let files: Vec<&str> = self.0.keys().map(String::as_str).collect();
        let own = [
            ("package.xml", package_xml(name, &robot)),
            ("CMakeLists.txt", cmake(name, &files)),
        ];
        let own = own.iter().map(|(file, text)| (*file, text));
        let all = self.0.iter().map(|(file, text)| (file.as_str(), text));
        for (file, text) in own.chain(all) {
            let path = folder.join(file);
            let parent = path.parent().unwrap_or(folder);
            let written = fs::create_dir_all(parent).and_then(|()| fs::write(&path, text));
            written.map_err(|error| format!("{}: {error}", path.display()))?;
        }
        Ok(())
    }
}

fn package_xml(name: &str, robot: &str) -> String {
    format!(
        r#"<?xml version="1.0"?>
{MARK}
<package format="3">
  <name>{name}</name>
  <version>0.0.0</version>
  <description>What the robot {robot} says and hears through hulkgen's bridge.</description>
  <maintainer email="nobody@example.com">{robot}</maintainer>
  <license>as the robot's</license>

  <buildtool_depend>ament_cmake</buildtool_depend>
  <buildtool_depend>rosidl_default_generators</buildtool_depend>
  <exec_depend>rosidl_default_runtime</exec_depend>
  <member_of_group>rosidl_interface_packages</member_of_group>

  <export>
    <build_type>ament_cmake</build_type>
  </export>
</package>
"#
    )
}

fn cmake(name: &str, files: &[&str]) -> String {
    let mut text = format!(
        "cmake_minimum_required(VERSION 3.8)\nproject({name})\n\nfind_package(ament_cmake REQUIRED)\nfind_package(rosidl_default_generators REQUIRED)\n"
    );
    text.push_str("\nrosidl_generate_interfaces(${PROJECT_NAME}\n");
    for file in files {
        let _ = writeln!(text, "  \"{file}\"");
    }
    text.push_str(")\n\nament_export_dependencies(rosidl_default_runtime)\nament_package()\n");
    text
}

/// As a .msg file, or half of a .srv file.
fn text(message: &Message) -> String {
    let mut text = String::new();
    for constant in &message.constants {
        let _ = writeln!(text, "uint32 {}={}", constant.name, constant.value);
    }
    for field in &message.fields {
        let kind = match &field.kind {
            Kind::Base(base) => (*base).to_owned(),
            // With its package: a service's own folder has no messages.
            Kind::Message(name) => name.replace("/msg/", "/"),
        };
        let many = match field.many {
            Many::One => String::new(),
            Many::Array(length) => format!("[{length}]"),
            Many::AtMost(most) => format!("[<={most}]"),
            Many::Any => "[]".to_owned(),
        };
        let _ = writeln!(text, "{kind}{many} {}", field.name);
    }
    text
}
