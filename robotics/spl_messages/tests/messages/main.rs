//! The messages against their published layouts, against themselves, and against hostile bytes.

mod control_data;
mod hostile;
mod return_data;
mod team_message;
mod values;
