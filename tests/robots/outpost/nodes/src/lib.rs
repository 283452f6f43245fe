//! The nodes of an outpost: some hear ships on another machine, one keeps a book of them.

pub mod interfaces;
pub mod keeper;
pub mod lookout;
pub mod types;
