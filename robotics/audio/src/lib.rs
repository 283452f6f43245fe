//! What the microphones hear: the nodes of cycler `Audio`.
//!
//! In the order of a cycle: [`microphone_recorder`], [`whistle_detection`].

pub mod microphone_recorder;

pub mod whistle_detection;
