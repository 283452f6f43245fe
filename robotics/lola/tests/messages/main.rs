//! The codec and the client against other implementations, a real socket, and hostile bytes.

mod wire;

mod codec;

mod allocation;
mod msgpack_oracle;

mod client;
