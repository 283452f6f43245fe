//! hulkgen-web
