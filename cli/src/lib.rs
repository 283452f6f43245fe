//! hulkgen: from a manifest and node crates to the crate that is the robot's runtime.
