//! hulkgen-schema
