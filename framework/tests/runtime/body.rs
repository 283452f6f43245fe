//! Two small cyclers in the style of generated code: `Eye` perceives, `Legs` consume what it saw.

use std::sync::Arc;
use std::time::{Duration, Instant};

use framework::LiveParameters;
use framework::cycler::{Reference, ReferenceKind};
use framework::recorded::{
    Describing, Digests, Loaded, Loading, Recorded, SaveError, Saving, Stored, Values,
};
use framework::{
    Access, AdditionalOutput, AdditionalSlot, Answerer, Body, Consumer, Cycle, Cycler, Guarded,
    Held, Horizon, InNode, Injected, Injection, InjectionCell, InjectionTable, Injector, Instance,
    InstanceDescription, Kind, NodeReport, OnFailure, OutputVisitor, PerceptionInput, QueueReport,
    Reader, Reflect, Result, Robot, Scheduling, Slots, State, Subscriptions, Swap, Timestamp,
    buffer, buffer_of, procedure,
};
use serde::{Deserialize, Serialize};

use crate::scripted::{Log, Script, ScriptedHardware};

#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub(crate) struct OwnOutputs {
    pub(crate) raw: u64,
}

#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub(crate) struct SharedOutputs {
    pub(crate) value: u64,
    /// Of other instances: what was persistent, what was transient.
    pub(crate) persistent: Vec<u64>,
    pub(crate) transient: Vec<u64>,
    /// Nanoseconds that must not depend on anything but the events.
    pub(crate) clock: u64,
    pub(crate) since_last: Duration,
    pub(crate) gain: u64,
    pub(crate) phase: Option<Phase>,
}

/// Of what `Legs` do.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub(crate) enum Phase {
    #[default]
    Stand,
    Walk {
        side: Side,
    },
}

#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub(crate) enum Side {
    #[default]
    Left,
    Right,
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Injections {
    pub(crate) raw: Injection<u64>,
    pub(crate) value: Injection<u64>,
}

impl InjectionTable for Injections {
    fn get_mut(&mut self, output: &str) -> Option<&mut dyn InjectionCell> {
        match output {
            "raw" => Some(&mut self.raw),
            "value" => Some(&mut self.value),
            _ => None,
        }
    }
}

#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub(crate) struct Parameters {
    pub(crate) gain: u64,
}

/// Reads the hardware.
#[derive(Debug, Default, Deserialize, Serialize)]
pub(crate) struct Receiver {
    received: u64,
}

/// Works on what was read.
#[derive(Debug, Default, Deserialize, Serialize)]
pub(crate) struct Worker {
    pub(crate) calls: u64,
}

/// Why a node does not do the same twice.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Mistake {
    AsksTheRealTime,
    IteratesAHashMap,
}

impl Mistake {
    fn make(self) -> u64 {
        match self {
            Self::AsksTheRealTime => {
                std::hint::black_box(Instant::now()).elapsed().as_nanos() as u64
            }
            Self::IteratesAHashMap => {
                #[expect(clippy::disallowed_types, reason = "it is the mistake")]
                let map: std::collections::HashMap<u64, ()> =
                    (0..64).map(|key| (key, ())).collect();
                map.into_keys()
                    .fold(0, |order, key| order.wrapping_mul(31).wrapping_add(key))
            }
        }
    }
}

/// What one instance is to do and where it is written down.
#[derive(Clone, Debug, Default)]
pub(crate) struct Plan {
    pub(crate) create: Script,
    pub(crate) receive: Script,
    pub(crate) work: Script,
    pub(crate) log: Log,
    pub(crate) required_is_absent: bool,
    /// Captured, instead of what the hardware says.
    pub(crate) captured: Option<fn(Timestamp) -> Timestamp>,
    /// What lockstep runs must show.
    pub(crate) mistake: Option<Mistake>,
    /// A panic outside of every node and of what the framework contains.
    pub(crate) nodes_panic: bool,
    pub(crate) answer: Option<fn(u32) -> Result<u32, String>>,
}

/// The perception instances that an instance consumes, at most two, by name.
#[derive(Default)]
pub(crate) struct Perception {
    horizon: Horizon,
    consumers: Vec<(&'static str, Consumer<SharedOutputs>)>,
}

impl Perception {
    fn consume(&mut self, now: Timestamp) {
        match self.consumers.as_mut_slice() {
            [] => {}
            [(_, only)] => self.horizon.consume(now, [only]),
            [(_, first), (_, second), ..] => self.horizon.consume(now, [first, second]),
        }
    }
}

pub(crate) struct TestBody {
    pub(crate) name: &'static str,
    pub(crate) receiver: Guarded<Receiver>,
    pub(crate) worker: Guarded<Worker>,
    pub(crate) own: Swap<OwnOutputs>,
    pub(crate) debug: AdditionalSlot<u64>,
    pub(crate) subscribed: bool,
    pub(crate) hardware: Arc<ScriptedHardware>,
    pub(crate) parameters: Reader<Parameters>,
    pub(crate) injections: Reader<Injected<Injections>>,
    pub(crate) subscriptions: Subscriptions,
    pub(crate) double: Answerer<u32, u32>,
    pub(crate) perception: Perception,
    pub(crate) on_failure: OnFailure,
    pub(crate) plan: Plan,
}

impl TestBody {
    fn log(&self, what: &str) {
        self.plan.log.add(format!("{} {what}", self.name));
    }

    fn work(&mut self, slots: Slots<'_, SharedOutputs>, cycle: Cycle) -> Result<()> {
        if self.plan.required_is_absent {
            slots.current.value = 0;
            self.worker.skip();
            return Ok(());
        }
        let plan = self.plan.clone();
        let raw = self.own.current().raw;
        let mut debug = AdditionalOutput::new(self.subscribed, cycle.number, &mut self.debug);
        let mut call = self.double.call();
        let node = |node: &mut Worker| {
            node.calls += 1;
            plan.work.next().perform()?;
            debug.fill_if_subscribed(|| raw * 100);
            if let (Some(call), Some(answer)) = (call.take(), plan.answer) {
                match answer(*call.request()) {
                    Ok(response) => call.answer(response),
                    Err(reason) => call.refuse(reason),
                }
            }
            Ok::<_, framework::Error>(raw + 1)
        };
        let outputs = match self.on_failure {
            OnFailure::Stop | OnFailure::Restart => Some(self.worker.call(&cycle, node)?),
            OnFailure::Skip => self.worker.call_or_skip(&cycle, node)?,
            OnFailure::Hold => match self.worker.call_or_hold(&cycle, node)? {
                Held::Written(outputs) => Some(outputs),
                Held::Hold => Some(slots.previous.value),
                Held::Skip => None,
            },
        };
        slots.current.value = outputs.unwrap_or_default();
        if let Some(injections) = self.injections.view().get() {
            injections.value.replace(&mut slots.current.value);
        }
        Ok(())
    }

    fn perceive(&self, shared: &mut SharedOutputs) {
        shared.persistent.clear();
        shared.transient.clear();
        for (_, consumer) in &self.perception.consumers {
            let projection = consumer.project(|outputs: &SharedOutputs| &outputs.value);
            let input = PerceptionInput::new(&projection);
            shared
                .persistent
                .extend(input.persistent.iter().map(|(_, value)| *value));
            shared
                .transient
                .extend(input.transient.iter().map(|(_, value)| *value));
        }
    }
}

/// Nothing of it is recorded.
impl Recorded for TestBody {
    type Outside = ();

    const DIGESTED: &'static [(&'static str, &'static str)] = &[];

    fn values(&self, _: &mut Values<'_, '_>) -> Result<(), SaveError> {
        Ok(())
    }

    fn save(
        &self,
        _: u64,
        _: Slots<'_, SharedOutputs>,
        _: Option<Timestamp>,
        _: &mut Saving<'_, '_>,
    ) {
    }

    fn describe(_: &mut Describing<Self>) {}

    fn load(
        &mut self,
        _: u64,
        _: Loaded<'_, SharedOutputs>,
        (): &mut (),
        _: &mut Loading<'_>,
        _: &Stored<'_>,
    ) -> Result<()> {
        Ok(())
    }

    fn digests(&self, _: &SharedOutputs, _: &mut Digests<'_, '_>) {}
}

impl Body for TestBody {
    type Shared = SharedOutputs;

    fn create(&mut self) -> Result<()> {
        self.log("create");
        self.plan.create.next().perform().in_node("test::worker")?;
        self.parameters.take();
        self.receiver = Guarded::new("test::receiver", self.on_failure, Receiver::default());
        self.worker = Guarded::new("test::worker", self.on_failure, Worker::default());
        Ok(())
    }

    fn wait(&mut self, _: Slots<'_, SharedOutputs>, cycle: Cycle) -> Result<Option<Timestamp>> {
        self.log("wait");
        self.parameters.take();
        self.receiver.renew_if_broken(|| Ok(Receiver::default()))?;
        let hardware = &self.hardware;
        let plan = &self.plan;
        let (captured, raw) = self.receiver.call(&cycle, |node| {
            node.received += 1;
            plan.receive.next().perform()?;
            hardware.read()
        })?;
        self.own.both().0.raw = raw;
        Ok(Some(self.plan.captured.map_or(captured, |captured| {
            captured(hardware.clock.now())
        })))
    }

    fn begin(&mut self, _: Slots<'_, SharedOutputs>, cycle: Cycle) {
        self.log("begin");
        self.parameters.take();
        self.injections.take();
        if self.subscriptions.changed() {
            self.subscribed = self.subscriptions.wanted().next_one();
        }
        self.double.take();
        self.perception.consume(cycle.time.start);
        if let Some(injections) = self.injections.view().get() {
            injections.raw.replace(&mut self.own.both().0.raw);
        }
    }

    fn run(&mut self, slots: Slots<'_, SharedOutputs>, cycle: Cycle) -> Result<()> {
        self.log("run");
        self.worker.renew_if_broken(|| Ok(Worker::default()))?;
        let Slots { current, previous } = slots;
        self.perceive(current);
        current.gain = self.parameters.view().gain;
        current.phase = Some(Phase::Stand);
        current.since_last = cycle.time.since_last;
        current.clock = match self.plan.mistake {
            Some(mistake) => mistake.make(),
            None => cycle.time.start.as_nanos(),
        };
        self.work(Slots { current, previous }, cycle)
    }

    fn finish(&mut self, _: &SharedOutputs, _: Cycle) {
        self.log("finish");
        self.own.swap();
        self.double.close();
    }

    fn abandon(&mut self) {
        self.log("abandon");
        self.double.close();
    }

    fn references(&self, visit: &mut dyn FnMut(Reference)) {
        visit(Reference {
            instance: "parameters",
            cycle: self.parameters.view().cycle(),
            kind: ReferenceKind::Latest,
        });
        for (name, consumer) in &self.perception.consumers {
            consumer.references(name, visit);
        }
    }

    fn main_outputs(&self) -> &'static [&'static str] {
        &[
            "raw",
            "value",
            "persistent",
            "transient",
            "clock",
            "since_last",
            "gain",
            "phase",
        ]
    }

    fn main_output<'a>(&'a self, shared: &'a SharedOutputs, name: &str) -> Option<&'a dyn Reflect> {
        Some(match name {
            "raw" => &self.own.previous().raw,
            "value" => &shared.value,
            "persistent" => &shared.persistent,
            "transient" => &shared.transient,
            "clock" => &shared.clock,
            "since_last" => &shared.since_last,
            "gain" => &shared.gain,
            "phase" => &shared.phase,
            _ => return None,
        })
    }

    fn additional_output(&self, name: &str, cycle: u64) -> Option<&dyn Reflect> {
        match name {
            "debug.raw" => self.debug.get(cycle).map(|value| value as &dyn Reflect),
            _ => None,
        }
    }

    fn outputs<'a>(
        &'a self,
        shared: &'a SharedOutputs,
        cycle: u64,
        visitor: &mut impl OutputVisitor<'a>,
    ) {
        visitor.output(Some(&self.own.previous().raw));
        visitor.output(Some(&shared.value));
        visitor.output(Some(&shared.persistent));
        visitor.output(Some(&shared.transient));
        visitor.output(Some(&shared.clock));
        visitor.output(Some(&shared.since_last));
        visitor.output(Some(&shared.gain));
        visitor.output(Some(&shared.phase));
        visitor.output(self.debug.get(cycle));
    }

    fn nodes(&self, visit: &mut dyn FnMut(NodeReport)) {
        let is_new = self.worker.report().calls == 0;
        assert!(is_new || !self.plan.nodes_panic, "nodes cannot be told");
        visit(self.receiver.report());
        visit(self.worker.report());
    }

    fn queues(&self, visit: &mut dyn FnMut(QueueReport)) {
        for (from, consumer) in &self.perception.consumers {
            visit(QueueReport {
                from,
                counts: consumer.report(),
            });
        }
    }

    fn states(&mut self, visit: &mut dyn FnMut(&'static str, &mut dyn State)) {
        visit("test::receiver", &mut self.receiver);
        visit("test::worker", &mut self.worker);
    }

    fn restore(&mut self) -> Result<()> {
        Ok(())
    }
}

/// What the manifest of the test robot says about its instances.
#[derive(Clone, Debug, Default)]
pub(crate) struct Setting {
    pub(crate) eye: Plan,
    pub(crate) legs: Plan,
    pub(crate) on_failure: OnFailure,
    pub(crate) eye_takes: Option<Duration>,
    /// There is an `Ear`, and its cycles take so long.
    pub(crate) ear_takes: Option<Duration>,
    pub(crate) deadline: Option<Duration>,
    pub(crate) legs_scheduling: Scheduling,
}

fn description(name: &'static str, kind: Kind, setting: &Setting) -> InstanceDescription {
    InstanceDescription {
        name,
        cycler: name,
        kind,
        on_failure: OnFailure::Stop,
        deadline: setting.deadline,
        pending_timeout: Duration::from_secs(1),
        watchdog: Duration::from_millis(100),
        history: Duration::from_secs(1),
        lockstep_duration: match name {
            "Eye" => setting.eye_takes,
            "Ear" => setting.ear_takes,
            _ => None,
        },
        scheduling: match name {
            "Legs" => setting.legs_scheduling,
            _ => Scheduling::default(),
        },
        record: framework::Record::On,
    }
}

/// `Eye` and `Legs`, in this order; then `Ear` if the setting wants one.
pub(crate) fn robot(hardware: &Arc<ScriptedHardware>, setting: &Setting) -> Robot<Parameters> {
    let (eye, [], [eye_for_legs]) = buffer([8]);
    let (legs, [], []) = buffer([]);
    let (ear, [], [ear_for_legs]) = buffer([8]);
    let (parameters, [of_eye, of_legs, of_ear], []) = buffer_of(|| Parameters { gain: 1 }, []);
    let (mut instances, mut access): (Vec<Box<dyn Instance>>, Vec<_>) = Default::default();
    let mut seen = Perception::default();
    let mut queues = vec![("Eye", eye_for_legs)];
    queues.extend(setting.ear_takes.map(|_| ("Ear", ear_for_legs)));
    for (name, queue) in queues {
        let consumer = Consumer::new(queue, Duration::from_secs(1));
        seen.consumers.push((name, consumer));
    }
    let (none, heard) = (Perception::default(), Perception::default());
    let ear_plan = Plan::default();
    let mut parts = vec![
        ("Eye", Kind::Perception, eye, none, of_eye, &setting.eye),
        ("Legs", Kind::RealTime, legs, seen, of_legs, &setting.legs),
    ];
    if setting.ear_takes.is_some() {
        parts.push(("Ear", Kind::Perception, ear, heard, of_ear, &ear_plan));
    }
    for (name, kind, writer, perception, parameters, plan) in parts {
        let subscriptions = Subscriptions::new(&["debug.raw"]);
        let (injector, [injections], []) = buffer([]);
        let (caller, double) = procedure();
        let on_failure = setting.on_failure;
        let body = TestBody {
            name,
            receiver: Guarded::new("test::receiver", on_failure, Receiver::default()),
            worker: Guarded::new("test::worker", on_failure, Worker::default()),
            own: Swap::default(),
            debug: AdditionalSlot::default(),
            subscribed: false,
            hardware: hardware.clone(),
            parameters,
            injections,
            subscriptions: subscriptions.clone(),
            double,
            perception,
            on_failure,
            plan: plan.clone(),
        };
        let description = description(name, kind, setting);
        instances.push(Box::new(Cycler::new(
            description,
            body,
            writer,
            hardware.clock.clone(),
        )));
        access.push(Access {
            instance: name,
            subscriptions,
            injector: Box::new(Injector::<Injections>::new(injector)),
            procedures: vec![("double", Box::new(caller))],
        });
    }
    Robot {
        name: "test",
        clock: hardware.clock.clone(),
        instances,
        access,
        left_out: &[],
        remotes: Vec::new(),
        parameters: LiveParameters::new(parameters, Parameters { gain: 1 }, hardware.clock.clone()),
    }
}
