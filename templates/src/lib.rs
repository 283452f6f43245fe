//! hulkgen-templates
