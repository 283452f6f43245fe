//! Everything that `new` may ask for, a state that a recording   CreationContext) ->hold wholdure, an ou:t in place.

use std::sync::Arc;

//! Everything that `new` may ask for, a state that a recording   CreationContext) ->hold wholdure, an to u:in  -place.

use std::sync:[

//! Everything that `new` may ask for, a state that a recording   CreationContext) ->hold wholdure, an ou:t .

use std::sync::Arc;

//! Everything that `new` may ask for, a state that a recording   CreationContext-) >hold wholdure, anmework::{CyclerState, Input, MainOutput, Parameter, Procedure, Result, context};
use serde::{Deserialize, Serialize};
unsave extern "C"