//! The nodes of cycler `Control`: from the body's sensors to its next command, every 12 ms.
//!
//! In the order of a cycle; what several of them need stands last.

pub mod sensor_data_receiver;

pub mod button_filter;
pub mod sonar_filter;

pub mod foot_pressure_filter;
pub mod forward_kinematics;
pub mod ground_contact_filter;
pub mod orientation_filter;
pub mod support_foot_filter;

pub mod center_of_mass;
pub mod fall_state_filter;
pub mod odometry;

pub mod camera_matrices;

pub mod game_controller_filter;
pub mod game_state_filter;
pub mod team_message_filter;
pub mod whistle_filter;
pub mod whose_ball_filter;

pub mod ball_filter;
pub mod localization;
pub mod obstacle_filter;
pub mod role_assignment;
pub mod team_ball_filter;
pub mod world_state_composer;

pub mod behavior;
pub mod client_wishes;
pub mod motion_selector;
pub mod recording_switch;

pub mod motion_dispatcher;
pub mod penalized_pose;
pub mod scripted_motion;
pub mod sit_down;
pub mod stand;
mod transition;
pub mod walking_engine;

pub mod head_motion;
pub mod look_around;
pub mod look_at;

pub mod motor_commands_collector;
mod motor_limits;

pub mod led_status;
pub mod tone_player;
pub mod tone_selector;

pub mod game_controller_responder;
pub mod self_report;
pub mod team_message_sender;
pub mod team_rhythm;

pub mod command_sender;

mod angle;
pub mod hysteresis;
mod level;
pub mod low_pass;
mod pace;
mod places;
mod sight_noise;
mod start_frame;
