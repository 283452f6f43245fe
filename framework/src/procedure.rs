//! Calls that a node answers, at most one per cycle.
//!
//! ```text
//! client: Caller::call(request) -> Pending ........................................ -> answer or refusal
//! instance:            begin: Answerer::take   node: Call::answer   finish: Answerer::close (unanswered = refused)
//! ```

use std::any::type_name;
use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{
    Receiver, RecvTimeoutError, SyncSender, TryRecvError, TrySendError, sync_channel,
};
use std::time::Duration;

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::error::Result;
use crate::parameters::Given;
use crate::reflect::{Reflect, Shape};

/// Calls that may wait for an instance; more are refused, so that clients cannot fill the memory.
const WAITING_CALLS: usize = 64;

/// Connects clients with the node that answers.
pub fn procedure<Request, Response>() -> (Caller<Request, Response>, Answerer<Request, Response>) {
    let (sender, receiver) = sync_channel(WAITING_CALLS);
    let sent = Arc::new(AtomicU64::new(0));
    let answerer = Answerer {
        sent: sent.clone(),
        received: 0,
        receiver,
        taken: None,
        asked: None,
    };
    (Caller { sender, sent }, answerer)
}

/// The clients' end of a procedure.
#[derive(Debug)]
pub struct Caller<Request, Response> {
    sender: SyncSender<Asked<Request, Response>>,
    /// How many calls all callers have put into the channel.
    sent: Arc<AtomicU64>,
}

/// The instance's end of a procedure.
#[derive(Debug)]
pub struct Answerer<Request, Response> {
    /// Mostly nobody calls: then this is all that a cycle looks at, and not the channel.
    sent: Arc<AtomicU64>,
    received: u64,
    receiver: Receiver<Asked<Request, Response>>,
    taken: Option<Asked<Request, Response>>,
    /// In a replay and in tests: what becomes of the call that [`Answerer::ask`] made.
    asked: Option<Pending<Response>>,
}

/// One call, as the node sees it in one cycle.
#[derive(Debug)]
pub struct Call<'cycle, Request, Response> {
    asked: &'cycle mut Option<Asked<Request, Response>>,
}

/// A call that was made, to wait for its answer.
#[derive(Debug)]
pub struct Pending<Response> {
    receiver: Receiver<Answer<Response>>,
}

/// Why a call has no response.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refused(pub Arc<str>);

/// What a call ends with.
pub type Answer<Response> = Result<Response, Refused>;

/// A procedure, whatever its types.
pub trait CallAny: Send + Sync {
    /// Full names of the types of its request and its response, for people.
    fn types(&self) -> (&'static str, &'static str);

    /// What its request and its response look like; `None` where they may be anything.
    fn shapes(&self) -> Option<(Shape, Shape)> {
        None
    }

    /// Makes a call; an error if it is no request of this procedure.
    fn call_any(&self, request: &Given<'_>) -> Result<Box<dyn PendingAny>>;
}

/// A call that was made, whatever its response.
pub trait PendingAny: Send {
    /// The answer, `None` if it does not come in time.
    fn wait_any(&self, timeout: Duration) -> Option<Answer<Box<dyn erased_serde::Serialize>>>;
}

struct Asked<Request, Response> {
    request: Request,
    answers: SyncSender<Answer<Response>>,
}

impl<Request, Response> Caller<Request, Response> {
    /// Asks; the node sees the call in one of the next cycles, in the order of the calls.
    pub fn call(&self, request: Request) -> Pending<Response> {
        let (answers, receiver) = sync_channel(1);
        match self.sender.try_send(Asked { request, answers }) {
            Ok(()) => {
                // Release: who sees it finds the call in the channel.
                self.sent.fetch_add(1, Ordering::Release);
            }
            Err(TrySendError::Full(asked)) => asked.finish(refuse("too many calls are waiting")),
            Err(TrySendError::Disconnected(asked)) => asked.finish(refuse("the robot has stopped")),
        }
        Pending { receiver }
    }
}

impl<Request, Response> Clone for Caller<Request, Response> {
    fn clone(&self) -> Self {
        Self {
            sender: self.sender.clone(),
            sent: self.sent.clone(),
        }
    }
}

impl<Response> Pending<Response> {
    /// The answer if it is there.
    pub fn try_answer(&self) -> Option<Answer<Response>> {
        match self.receiver.try_recv() {
            Ok(answer) => Some(answer),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(refuse("the robot has stopped")),
        }
    }

    /// The answer, `None` if it does not come in time.
    pub fn wait_timeout(&self, timeout: Duration) -> Option<Answer<Response>> {
        match self.receiver.recv_timeout(timeout) {
            Ok(answer) => Some(answer),
            Err(RecvTimeoutError::Timeout) => None,
            Err(RecvTimeoutError::Disconnected) => Some(refuse("the robot has stopped")),
        }
    }
}

impl<Request, Response> Answerer<Request, Response> {
    /// Takes the next call for this cycle; neither blocks nor allocates.
    #[inline]
    pub fn take(&mut self) {
        // Acquire: with the number come the calls.
        if self.taken.is_none() && self.sent.load(Ordering::Acquire) != self.received {
            self.taken = self.receiver.try_recv().ok();
            self.received += u64::from(self.taken.is_some());
        }
    }

    /// The call of this cycle until it is answered.
    #[inline]
    pub fn call(&mut self) -> Option<Call<'_, Request, Response>> {
        self.taken.is_some().then_some(Call {
            asked: &mut self.taken,
        })
    }

    /// What was taken and is not answered yet; for a recording.
    pub fn request(&self) -> Option<&Request> {
        self.taken.as_ref().map(|asked| &asked.request)
    }

    /// The call of this cycle, without a client; [`Self::answered`] tells what comes of it.
    pub(crate) fn ask(&mut self, request: Option<Request>) {
        self.asked = None;
        self.taken = request.map(|request| {
            let (answers, receiver) = sync_channel(1);
            self.asked = Some(Pending { receiver });
            Asked { request, answers }
        });
    }

    /// What the call that [`Self::ask`] made ended with; once.
    pub(crate) fn answered(&self) -> Option<Answer<Response>> {
        self.asked.as_ref()?.try_answer()
    }

    /// Ends the cycle: what is not answered is refused.
    #[inline]
    pub fn close(&mut self) {
        if let Some(asked) = self.taken.take() {
            asked.finish(refuse("the node did not answer"));
        }
    }
}

impl<Request, Response> Call<'_, Request, Response> {
    /// What the client asks.
    pub fn request(&self) -> &Request {
        let asked = self
            .asked
            .as_ref()
            .expect("a call is made of a taken one and ends when it is answered");
        &asked.request
    }

    /// Gives the client its response.
    pub fn answer(self, response: Response) {
        self.finish(Ok(response));
    }

    /// Tells the client why there is no response.
    pub fn refuse(self, reason: impl Into<String>) {
        self.finish(refuse(&reason.into()));
    }

    fn finish(self, answer: Answer<Response>) {
        if let Some(asked) = self.asked.take() {
            asked.finish(answer);
        }
    }
}

impl<Request, Response> Asked<Request, Response> {
    fn finish(self, answer: Answer<Response>) {
        // Fails if the client does not wait any more, which is its right.
        let _ = self.answers.try_send(answer);
    }
}

impl<Request, Response> CallAny for Caller<Request, Response>
where
    Request: DeserializeOwned + Reflect + Send,
    Response: Reflect + Serialize + Send + 'static,
{
    fn types(&self) -> (&'static str, &'static str) {
        (type_name::<Request>(), type_name::<Response>())
    }

    fn shapes(&self) -> Option<(Shape, Shape)> {
        Some((Request::shape(), Response::shape()))
    }

    fn call_any(&self, request: &Given<'_>) -> Result<Box<dyn PendingAny>> {
        Ok(Box::new(self.call(request.read()?)))
    }
}

impl<Response: Serialize + Send + 'static> PendingAny for Pending<Response> {
    fn wait_any(&self, timeout: Duration) -> Option<Answer<Box<dyn erased_serde::Serialize>>> {
        let answer = self.wait_timeout(timeout)?;
        Some(answer.map(|response| Box::new(response) as Box<dyn erased_serde::Serialize>))
    }
}

impl<Request, Response> fmt::Debug for Asked<Request, Response> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("Asked").finish_non_exhaustive()
    }
}

impl fmt::Display for Refused {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "refused: {}", self.0)
    }
}

impl std::error::Error for Refused {}

fn refuse<Response>(reason: &str) -> Answer<Response> {
    Err(Refused(reason.into()))
}
