//! The same robot for MuJoCo: links, masses, rooms, motors, and the pose in which it begins.

use std::fmt::Write as _;

use kinematics::limits;
use kinematics::links::{LINKS, Link, LinkName, Mass, TORSO};
use types::joints::JointName;

use super::super::{Body, STEP, Start};
use super::articulation::share;
use super::motor::Servo;
use super::shape::{Volume, volume};

/// What comes beside the tree of bodies, in its order.
#[derive(Default)]
struct Lists {
    actuators: String,
    angles: Vec<f64>,
    controls: Vec<f64>,
}

/// The model of one robot on the carpet, in MuJoCo's XML, with a key frame `start`.
///
/// Motors are position servos with the torque of full stiffness; that it grows less with speed is left out.
pub fn mjcf(start: &Start) -> String {
    let torso = Body::standing(start).torso_to_field;
    let place = torso.translation.vector;
    let turn = torso.rotation;
    let mut lists = Lists::default();
    let mut links = String::new();
    describe_mass(&mut links, 6, &TORSO);
    describe_room(&mut links, 6, LinkName::Torso);
    for link in LINKS.iter().filter(|link| link.parent == LinkName::Torso) {
        describe_link(&mut links, 6, link, start, &mut lists);
    }
    let root = [place.x, place.y, place.z, turn.w, turn.i, turn.j, turn.k];
    let positions = numbers(root.iter().chain(&lists.angles));
    let controls = numbers(&lists.controls);
    format!(
        r#"<mujoco model="nao">
  <compiler angle="radian" autolimits="true"/>
  <option timestep="{step}" integrator="implicitfast"/>
  <worldbody>
    <light pos="0 0 3"/>
    <geom name="carpet" type="plane" size="6 4 1" contype="2" conaffinity="1"/>
    <body name="Torso" pos="{position}">
      <freejoint name="Torso"/>
{links}    </body>
  </worldbody>
  <equality>
    <joint joint1="{right}" joint2="{left}" polycoef="0 1 0 0 0"/>
  </equality>
  <actuator>
{actuators}  </actuator>
  <keyframe>
    <key name="start" qpos="{positions}" ctrl="{controls}"/>
  </keyframe>
</mujoco>
"#,
        step = STEP.as_secs_f64(),
        position = numbers(&[place.x, place.y, place.z]),
        left = joint_name(LinkName::LeftPelvis, JointName::HipYawPitch),
        right = joint_name(LinkName::RightPelvis, JointName::HipYawPitch),
        actuators = lists.actuators,
    )
}

fn describe_link(text: &mut String, indent: usize, link: &Link, start: &Start, lists: &mut Lists) {
    let pad = " ".repeat(indent);
    let name = joint_name(link.name, link.joint);
    let (servo, limits) = (Servo::of(link.joint), limits::of(link.joint));
    let share = share(link.joint);
    // A text can always be written to.
    let _ = writeln!(
        text,
        "{pad}<body name=\"{:?}\" pos=\"{}\">\n{pad}  <joint name=\"{name}\" axis=\"{}\" range=\"{} {}\" armature=\"{}\" frictionloss=\"{}\"/>",
        link.name,
        numbers(&link.origin),
        numbers(&link.axis),
        limits.lower,
        limits.upper,
        servo.armature * share,
        servo.friction * share,
    );
    describe_mass(text, indent + 2, &link.mass);
    describe_room(text, indent + 2, link.name);
    let torque = servo.torque * share;
    let _ = writeln!(
        lists.actuators,
        "    <position name=\"{name}\" joint=\"{name}\" kp=\"{}\" kv=\"{}\" forcerange=\"{} {torque}\"/>",
        servo.proportional * share,
        servo.derivative * share,
        -torque,
    );
    let angle = start.joints[link.joint];
    lists.angles.push(angle);
    lists.controls.push(angle);
    for child in LINKS.iter().filter(|child| child.parent == link.name) {
        describe_link(text, indent + 2, child, start, lists);
    }
    let _ = writeln!(text, "{pad}</body>");
}

fn describe_mass(text: &mut String, indent: usize, mass: &Mass) {
    let pad = " ".repeat(indent);
    let _ = writeln!(
        text,
        "{pad}<inertial pos=\"{}\" mass=\"{}\" fullinertia=\"{}\"/>",
        numbers(&mass.center),
        mass.mass,
        numbers(&mass.inertia)
    );
}

/// Links of a robot do not touch each other, as here.
fn describe_room(text: &mut String, indent: usize, link: LinkName) {
    let Some((volume, friction)) = volume(link) else {
        return;
    };
    let pad = " ".repeat(indent);
    let (kind, center, size) = match volume {
        Volume::Ball { center, radius } => ("sphere", center, numbers(&[radius])),
        Volume::Box { center, half } => ("box", center, numbers(&half)),
    };
    let _ = writeln!(
        text,
        "{pad}<geom type=\"{kind}\" pos=\"{}\" size=\"{size}\" friction=\"{friction} 0.005 0.0001\" priority=\"1\" contype=\"1\" conaffinity=\"2\"/>",
        numbers(&center)
    );
}

/// One motor turns two hinges at the hips; each has a name.
fn joint_name(link: LinkName, joint: JointName) -> String {
    match link {
        LinkName::RightPelvis => format!("{joint:?}Right"),
        _ => format!("{joint:?}"),
    }
}

fn numbers<'a>(numbers: impl IntoIterator<Item = &'a f64>) -> String {
    let numbers: Vec<_> = numbers.into_iter().map(f64::to_string).collect();
    numbers.join(" ")
}
