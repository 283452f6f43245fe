//! lola
