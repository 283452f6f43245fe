//! hulkgen-framework-loom
