//! hulkgen-framework-macros
