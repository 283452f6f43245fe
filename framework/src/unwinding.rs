//! Failures of one node end at that node (see [`crate::guarded`]): a panic must unwind.

#[cfg(panic = "abort")]
compile_error!(
    "a robot must not be built with `panic = \"abort\"`: one node's panic would end all cyclers and leave the \
     hardware without its safe state; remove the line from the profile in Cargo.toml"
);
