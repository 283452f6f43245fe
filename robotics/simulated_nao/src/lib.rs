//! simulated_nao
