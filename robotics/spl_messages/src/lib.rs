//! The messages of the RoboCup Standard Platform League, byte for byte, whoever sends them.
//!
//! What a referee's computer (GameController) tells the robots is [`control_data`], what each robot
//! answers is [`return_data`], what the robots of a team tell each other is [`team_message`]. Encoding
//! and decoding do no I/O and allocate nothing; decoding refuses whatever is not exactly a message,
//! and [`DecodeError`] says what came instead.

pub mod control_data;
pub mod return_data;
pub mod team_message;

pub mod error;

mod bytes;

pub use error::{DecodeError, EncodeError};
pub use return_data::ReturnData;
