"""Lets MuJoCo load the exported robot and hold its pose for five seconds."""

import sys

try:
    import mujoco
except ImportError:
    sys.exit(77)

model = mujoco.MjModel.from_xml_path(sys.argv[1])
data = mujoco.MjData(model)
mass = sum(model.body_mass)
assert abs(mass - 5.35975) < 1e-3, f"{mass} kg"
mujoco.mj_resetDataKeyframe(model, data, model.key("start").id)
mujoco.mj_forward(model, data)
height = data.body("Torso").xpos[2]
while data.time < 5.0:
    mujoco.mj_step(model, data)
up = data.body("Torso").xmat[8]
sunk = height - data.body("Torso").xpos[2]
print(f"mass {mass:.5f} kg, torso {height:.4f} m high, after 5 s {sunk * 1000:.1f} mm lower, cos(tilt) {up:.5f}")
assert up > 0.995, f"it leans or has fallen: {up}"
assert abs(sunk) < 0.02, f"it sank by {sunk} m"
