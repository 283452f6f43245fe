//! The tools by their digests, as pip takes them.

/// Zig links against any version of glibc; cargo-zigbuild lets cargo link through it. Digests are those of the wheels on PyPI.
pub(super) const REQUIREMENTS: &str = "\
cargo-zigbuild==0.24.0 \\
    --hash=sha256:484412e39e4c6039474535ce97ee75a22bab22d58233056f8ec8a8f9034bb957 \\
    --hash=sha256:6942e4320f7b05d8fb29e0a8ce5670bcbb3d254275100b85b5b7c86552f9a744
ziglang==0.15.1 \\
    --hash=sha256:4e45994a0e608d9b16ecad255698f5557a2e24de0bd7ba9efb156ab3f3683d9a \\
    --hash=sha256:6c32697f9e165b7b6c5950ab0a1cd2e2bc3e72f4ff2d59bc5121b2b71955a77a
";
