//! In the steady state nothing is allocated.

mod counting;
mod cycle;
mod exchange;
mod reading;
