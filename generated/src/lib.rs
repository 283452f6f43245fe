//! nao_runtime
