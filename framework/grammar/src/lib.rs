//! hulkgen-grammar
