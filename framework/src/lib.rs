//! The runtime of a robot: what nodes see, what generated code calls, and what drives it all.
//!
//! A robot is a set of cycler *instances*. Each turns through cycles of four calls, `wait`, `begin`, `run`, `finish`, and
//! shares nothing with the others but buffers that nobody has to wait for. Reading order, along the life of a cycle:
//!
//! | Module | Owns |
//! |---|---|
//! | [`launch`], [`parameters`], [`hardware`] | from the command line and the parameter layers to a running robot |
//! | [`robot`], [`driver`], [`rearm`] | the instances put together, and the two ways to turn them: threads and lockstep |
//! | [`cycler`] | one instance: the four calls around its generated body |
//! | [`scenario`] | a simulated robot lives through what a file says, and is judged by what it asserts |
//! | [`scheduling`] | what its thread asks of the operating system, and what it got |
//! | [`guarded`], [`error`] | one node: failures and panics end here |
//! | [`mod@context`], [`mod@procedure`] | what a node sees: the kinds of the context fields |
//! | [`mod@buffer`] | the newest database of an instance, without blocking, lock or copy; the only unsafe code |
//! | [`stub`] | what stands in for an instance that a partial robot does without |
//! | [`pool`] | large values that are handed on by handle |
//! | [`temporal`], [`history`] | results of perception in order of time; own outputs by time |
//! | [`recorded`], [`replay`], [`numerics`] | what a cycle took, saved and given back; recorded cycles run again |
//! | [`math`] | elementary functions that give the same bits on every machine |
//! | [`subscriptions`], [`injection`] | clients: listen to an output, replace one |
//! | [`logs`] | what nodes say, with instance and cycle, for whoever collects it |
//! | [`tap`], [`link`] | copies of outputs for a communication server, and all else that it may see and change |
//! | [`world`] | what clients may know of a simulated world, and do to it |
//! | [`time`], [`clock`], [`stop`], [`timing`], [`report`] | when, until when, how long, and how to tell |
//! | [`reflect`], [`data`], [`clear`], [`digest`] | what values must be able to do |
//! | [`testing`] | all of it for the test of a single node |

// So that what the macros write holds in here, too.
extern crate self as framework;

pub mod buffer;
pub mod bytes;
pub mod clear;
pub mod clock;
pub mod context;
pub mod cycler;
pub mod data;
pub mod digest;
pub mod driver;
pub mod error;
pub mod foxglove;
pub mod guarded;
pub mod hardware;
pub mod history;
pub mod injection;
pub mod launch;
pub mod link;
pub mod logs;
pub mod math;
pub mod numerics;
pub mod parameters;
pub mod pool;
pub mod procedure;
pub mod rearm;
pub mod recorded;
pub mod reflect;
pub mod remote;
pub mod replay;
pub mod report;
pub mod robot;
pub mod scenario;
pub mod scheduling;
mod split_mix;
pub mod stop;
pub mod stub;
pub mod subscriptions;
pub mod tap;
pub mod temporal;
pub mod testing;
pub mod time;
pub mod timing;
pub mod tool;
mod unwinding;
pub mod world;

pub use buffer::{Entry, Latest, Queue, Reader, View, Writer, buffer, buffer_of};
pub use clear::Clear;
pub use clock::Clock;
pub use context::{
    AdditionalOutput, AdditionalSlot, CaptureTime, CyclerState, HardwareInterface, InPlace, Input,
    LatestInput, MainOutput, Parameter, PreviousInput, Procedure, ReadState, RequiredInput,
};
pub use cycler::{
    Body, Cycle, Cycler, Finished, Instance, InstanceDescription, Kind, Record, Restarted, Slots,
    Swap, Waited,
};
pub use data::{Data, NodeState, ParameterData};
pub use digest::Digest;
pub use driver::{Lockstep, Paused, SafeState, Threads, Together};
pub use error::{Error, InNode, NoEvent, Result, Stopped};
pub use framework_macros::{Clear, Reflect, context};
pub use guarded::{Condition, Guarded, Held, OnFailure, State};
pub use hardware::{Event, Hardware, HardwareContext};
pub use history::{HistoricInput, History, Past, Stored};
pub use injection::{Inject, Injected, Injection, InjectionCell, InjectionTable, Injector};
pub use launch::Target;
pub use link::{InstanceLink, Link};
pub use parameters::{Given, LiveParameters};
pub use pool::{Free, Leased, Pool};
pub use procedure::{Answerer, Call, CallAny, Caller, Pending, PendingAny, Refused, procedure};
pub use rearm::Rearm;
pub use reflect::Reflect;
pub use remote::{Feed, FeedCounts, Remote};
pub use report::{InstanceReport, NodeReport, QueueReport, RobotReport};
pub use robot::{Access, Robot, Start};
pub use scheduling::{Granted, Policy, Scheduling};
pub use stop::Stop;
pub use stub::Stub;
pub use subscriptions::Subscriptions;
pub use tap::{OutputKind, OutputVisitor, Tap, Tapped};
pub use temporal::{
    Consumer, Horizon, Interleaved, Interleaving, Item, Lane, PerceptionInput, Projection,
    QueueCounts, Reference, ReferenceKind, RollBack, Series, Timeline, interleave,
};
pub use time::{CycleTime, Timestamp};
pub use timing::{CountingAllocator, Histogram, blocking};
