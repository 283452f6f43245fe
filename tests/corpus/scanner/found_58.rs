pub mod mod  pu pub mod  mo/ pub p mod  pu pub mod  mo/ pub pubpub >, report:b"considered pub mo/ pubb mod mod cod pub mod mod cod pub mod mod co">,
pubpub >, report:b"considered pub mo/ pubb mod mod cod pub mod mod cod pub mod mod co">,
pub mod mod  pu pub mo/ pub pubpub >, report:b"considered pub mo/ pubb mod mod cod pub mod mod cod pub mod mod co">,
 report