//! Stations of the window: in a thread, with a pool of threads that leaves a core to the interface.

use crate::stations::{RequestNumber, StationNews, StationTask};
use gonio_beyond::{STATIONS, StationDescription, StationRequest, StationWork};
use gonio_language::tr;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::time::Instant;

/// In place of the newest request's number: the work is paused, or nobody waits for it any more.
const PAUSED: u32 = 0;
const ENDED: u32 = u32::MAX;

/// Stations computed in a thread.
pub struct ThreadStations {
    requests: Sender<(RequestNumber, StationRequest)>,
    news: Receiver<StationNews>,
    newest: Arc<AtomicU32>,
    is_lost: bool,
}

impl ThreadStations {
    /// Starts the thread; `ctx` is repainted with all news.
    pub fn start(ctx: &egui::Context) -> Self {
        let (requests, received) = channel();
        let (sender, news) = channel();
        let newest = Arc::new(AtomicU32::new(PAUSED));
        let worker = Worker { newest: newest.clone(), news: sender, ctx: ctx.clone() };
        std::thread::spawn(move || worker.run(&received));
        ThreadStations { requests, news, newest, is_lost: false }
    }
}

impl StationTask for ThreadStations {
    fn request(&mut self, number: RequestNumber, request: &StationRequest) {
        self.newest.store(number, Ordering::Relaxed);
        // If the thread has ended, `poll` says so.
        let _ = self.requests.send((number, request.clone()));
    }

    fn pause(&mut self) {
        self.newest.store(PAUSED, Ordering::Relaxed);
    }

    fn poll(&mut self) -> Option<StationNews> {
        match self.news.try_recv() {
            Ok(news) => Some(news),
            Err(TryRecvError::Disconnected) if !self.is_lost => {
                self.is_lost = true;
                Some(StationNews::Failed(tr!("window-the-station-cannot-be-computed-the").to_owned()))
            }
            Err(_) => None,
        }
    }
}

impl Drop for ThreadStations {
    fn drop(&mut self) {
        self.newest.store(ENDED, Ordering::Relaxed);
    }
}

struct Worker {
    newest: Arc<AtomicU32>,
    news: Sender<StationNews>,
    ctx: egui::Context,
}

impl Worker {
    fn run(&self, requests: &Receiver<(RequestNumber, StationRequest)>) {
        let pool = super::thread_pool();
        let start = Instant::now();
        let clock = || 1e3 * start.elapsed().as_secs_f64();
        let mut work = StationWork::default();
        self.tell(StationNews::Stations(STATIONS.iter().map(StationDescription::from).collect()));
        while let Ok(mut next) = requests.recv() {
            while let Ok(newer) = requests.try_recv() {
                next = newer;
            }
            let (number, request) = next;
            let begun = || {
                work.begin(request, clock());
                self.advance(number, &mut work, &clock);
            };
            match &pool {
                Some(pool) => pool.install(begun),
                None => begun(),
            }
        }
    }

    /// Works until nothing is left to do, or another request has arrived and there is something to show of this one.
    fn advance(&self, number: RequestNumber, work: &mut StationWork, clock: &(dyn Fn() -> f64 + Sync)) {
        loop {
            let is_presentable = work.is_presentable();
            let goes_on = || match self.newest.load(Ordering::Relaxed) {
                ENDED => false,
                newest => newest == number || !is_presentable,
            };
            if !goes_on() {
                return;
            }
            let (result, is_left) = work.advance(clock, &goes_on);
            if let Some(result) = result {
                self.tell(StationNews::Result(number, result));
            }
            if !is_left {
                self.tell(StationNews::Finished(number));
                return;
            }
        }
    }

    fn tell(&self, news: StationNews) {
        // The room may be closed by now.
        let _ = self.news.send(news);
        self.ctx.request_repaint();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_beyond::StationResult;
    use gonio_plot::PlotTheme;
    use std::time::Duration;

    /// While a slider is dragged, each frame requests another picture, and some are seen; then the newest is finished.
    #[test]
    fn pictures_are_seen_while_requests_follow_each_other_and_the_last_is_finished() {
        let mut task = ThreadStations::start(&egui::Context::default());
        let (mut number, mut seen) = (0, 0);
        while seen < 3 {
            number += 1;
            assert!(number < 20_000, "no picture in {number} requests");
            task.request(number, &request(f64::from(number) * 1e-3));
            std::thread::sleep(Duration::from_millis(1));
            while let Some(news) = task.poll() {
                seen += u32::from(matches!(news, StationNews::Result(_, StationResult::Picture(_))));
            }
        }
        let mut results = Vec::new();
        loop {
            match task.poll() {
                Some(StationNews::Finished(of)) if of == number => break,
                Some(StationNews::Result(of, result)) if of == number => results.push(result),
                Some(StationNews::Failed(error)) => panic!("{error}"),
                _ => std::thread::sleep(Duration::from_millis(1)),
            }
        }
        assert!(results.iter().any(|result| matches!(result, StationResult::Checks(_))));
    }

    fn request(time: f64) -> StationRequest {
        StationRequest {
            station: "phosphorescence".to_owned(),
            values: vec![("time".to_owned(), time)],
            picture: 0,
            size: [80, 60],
            plot_size: [300, 200],
            theme: PlotTheme::Light,
        }
    }
}
