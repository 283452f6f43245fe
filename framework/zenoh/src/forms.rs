//! How the values of an edge are laid out, by the robot's own words.

use client::Robot;
use protocol::{Ask, Good};

use crate::edges::{Edge, Kind};
use crate::layout::Layout;
use crate::trouble::Trouble;

/// Of an edge whose values are CDR.
pub(crate) enum Form {
    /// An output or a parameter.
    Value(Layout),
    /// A procedure.
    Call { request: Layout, response: Layout },
}

impl Form {
    /// # Errors
    /// If the robot does not tell, or CDR has no form for it.
    pub(crate) fn ask(robot: &mut Robot, edge: &Edge) -> Result<Self, Trouble> {
        let path = &edge.path;
        let mut layout = |path: String| match robot.ask(Ask::Layout { path })? {
            Good::Layout(layout) => Ok(Layout::read(layout)?),
            _ => Err(Trouble::Refused("the robot tells no layout".to_owned())),
        };
        Ok(match edge.kind {
            Kind::Procedure => Self::Call {
                request: layout(format!("{path}.request"))?,
                response: layout(format!("{path}.response"))?,
            },
            _ => Self::Value(layout(path.clone())?),
        })
    }

    /// Of what comes in.
    pub(crate) fn input(&self) -> &Layout {
        match self {
            Self::Value(layout)
            | Self::Call {
                request: layout, ..
            } => layout,
        }
    }

    /// Of what goes out.
    pub(crate) fn output(&self) -> &Layout {
        match self {
            Self::Value(layout)
            | Self::Call {
                response: layout, ..
            } => layout,
        }
    }
}
