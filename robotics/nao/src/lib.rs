//! A NAO V6: its body through LoLA, cameras through V4L2, microphones and loudspeakers through ALSA, the game's network.
//!
//! In reading order: what can be chosen ([`settings`]), the hardware as the framework and the nodes see it ([`Hardware`]), and
//! behind it cameras, sound, the thread that lets the robot down, and what systemd is told. Cameras and microphones may as well
//! be those of another process (`nao_simulator`) or a file, so that all of it runs without a robot.
//!
//! Everything that was not tried on a robot is listed in `docs/guides/real-nao.md`.

pub mod settings;

mod body;
mod cameras;
mod hardware;
mod kernel;
mod network;
mod remote;
mod sound;
mod supervisor;

pub use hardware::Hardware;
