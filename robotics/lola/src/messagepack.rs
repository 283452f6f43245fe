//! Owns as much of MessagePack as LoLA speaks (specification at msgpack.org).

mod read;
mod write;

pub(crate) use read::Reader;
pub(crate) use write::Writer;
