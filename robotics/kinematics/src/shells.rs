//! Owns the boxes around the links: how much room each part takes.

use crate::links::LinkName;

/// A box along the axes of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shell {
    /// The least coordinates in the link's frame, in m.
    pub lowest: [f64; 3],
    /// The greatest coordinates in the link's frame, in m.
    pub highest: [f64; 3],
}

/// The box around the manufacturer's mesh of a link (NAO V6); `None` for the elbows, which have no mesh
/// of their own.
pub const fn of(link: LinkName) -> Option<Shell> {
    let (lowest, highest) = match link {
        LinkName::Torso => ([-0.0527, -0.087, -0.0964], [0.0589, 0.087, 0.133]),
        LinkName::Neck => ([-0.0126, -0.0126, -0.0125], [0.0126, 0.0126, 0.0127]),
        LinkName::Head => ([-0.0606, -0.0664, -0.0008], [0.0587, 0.0663, 0.1136]),
        LinkName::LeftShoulder => ([-0.0331, -0.0258, -0.033], [0.0329, -0.0019, 0.0329]),
        LinkName::LeftUpperArm => ([-0.0472, -0.0251, -0.0408], [0.1223, 0.0362, 0.0408]),
        LinkName::LeftForearm => ([-0.0129, -0.0217, -0.0231], [0.0572, 0.027, 0.0283]),
        LinkName::LeftHand => ([0.0, -0.0341, -0.0317], [0.0848, 0.0341, 0.0313]),
        LinkName::RightShoulder => ([-0.0331, 0.0019, -0.033], [0.0329, 0.0258, 0.0329]),
        LinkName::RightUpperArm => ([-0.0472, -0.0362, -0.0408], [0.1223, 0.0251, 0.0408]),
        LinkName::RightForearm => ([-0.0129, -0.027, -0.0231], [0.0572, 0.0217, 0.0283]),
        LinkName::RightHand => ([0.0, -0.0341, -0.0317], [0.0848, 0.0341, 0.0313]),
        LinkName::LeftPelvis => ([-0.0569, -0.0369, -0.0134], [0.0239, 0.0136, 0.0433]),
        LinkName::LeftHip => ([-0.0427, -0.0137, -0.0339], [0.0242, 0.0146, 0.0178]),
        LinkName::LeftThigh => ([-0.0447, -0.0413, -0.1242], [0.0512, 0.0483, 0.0167]),
        LinkName::LeftTibia => ([-0.0396, -0.0413, -0.1258], [0.0501, 0.052, 0.0217]),
        LinkName::LeftAnkle => ([-0.0398, -0.0143, -0.0144], [0.0443, 0.0142, 0.0474]),
        LinkName::LeftFoot => ([-0.0594, -0.0388, -0.0453], [0.1021, 0.0517, 0.0193]),
        LinkName::RightPelvis => ([-0.0569, -0.0136, -0.0134], [0.0239, 0.0369, 0.0433]),
        LinkName::RightHip => ([-0.0427, -0.0135, -0.0348], [0.0242, 0.0147, 0.0169]),
        LinkName::RightThigh => ([-0.0447, -0.0483, -0.1242], [0.0512, 0.0413, 0.0167]),
        LinkName::RightTibia => ([-0.0396, -0.052, -0.1258], [0.0501, 0.0413, 0.0217]),
        LinkName::RightAnkle => ([-0.0398, -0.0142, -0.0144], [0.0443, 0.0143, 0.0474]),
        LinkName::RightFoot => ([-0.0594, -0.0517, -0.0453], [0.1021, 0.0388, 0.0193]),
        LinkName::LeftElbow | LinkName::RightElbow => return None,
    };
    Some(Shell { lowest, highest })
}
