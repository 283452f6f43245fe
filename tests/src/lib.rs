//! hulkgen-tests
