//! hulkgen-framework
