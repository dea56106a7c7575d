//! Messages, which stay until they are dismissed or their cause is gone.

/// Severity of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum MessageSeverity {
    /// Worth knowing.
    Note,
    /// The result is not as expected.
    Warning,
    /// The operation failed.
    Error,
}

/// The cause of a message: when it is gone, so are its messages ([`Messages::clear`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum MessageCause {
    /// Something that happened once, and anything that is withdrawn by its text.
    #[default]
    Event,
    /// A scene or file that could not be opened; gone when one can be.
    Opening,
    /// The files of the open scene; gone when they are read again.
    Scene,
    /// Files that were dropped on an exercise; gone when others are taken, or another exercise is begun.
    ExerciseFiles,
    /// A file that was dropped on the BRDF bench; gone when it is read again.
    BenchFiles,
    /// Unsaved text when the window was to be closed; gone when it is saved.
    Closing,
    /// Models may lie on their side; gone when they are turned or another scene is opened.
    UpAxis,
    /// An edited scene was replaced; gone when it is restored or replaced by a newer one.
    Replaced,
    /// An earlier window left edits of the scene; gone when they are restored or discarded, or another scene is opened.
    Draft,
}

/// What can be done about a message, as a button beside it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MessageAnswer {
    /// Restores the edited scene that another one has replaced.
    RestoreScene,
    /// Restores or discards the edits that an earlier window left of the scene.
    RestoreDraft,
    /// Turns all models so that their z axis points up.
    TurnZUp,
}

/// A message of one sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UserMessage {
    /// Identifies the message; newer ones have larger numbers.
    pub id: u64,
    /// Severity of a message.
    pub severity: MessageSeverity,
    /// Its cause.
    pub cause: MessageCause,
    /// The file that it concerns: messages about one file are shown together.
    pub file: Option<String>,
    /// The sentence.
    pub text: String,
    /// Number of times that it was reported.
    pub times: u32,
    /// What can be done about it.
    pub answer: Option<MessageAnswer>,
}

/// Messages that have not been dismissed.
#[derive(Clone, Debug, Default)]
pub struct Messages {
    list: Vec<UserMessage>,
    next: u64,
    /// Whether all are shown, or only as many as need little room.
    pub is_expanded: bool,
}

impl Messages {
    /// Adds a message about an event.
    pub fn report(&mut self, severity: MessageSeverity, text: impl Into<String>) {
        self.report_about(MessageCause::Event, severity, None, text);
    }

    /// Adds a message with its cause, perhaps about a file. A repeated one is counted and is the newest again.
    pub fn report_about(
        &mut self,
        cause: MessageCause,
        severity: MessageSeverity,
        file: Option<String>,
        text: impl Into<String>,
    ) {
        let text = text.into();
        let known = self.list.iter().position(|m| m.severity == severity && m.text == text);
        let times = known.map_or(0, |known| self.list.remove(known).times) + 1;
        self.list.push(UserMessage { id: self.next, severity, cause, file, text, times, answer: None });
        self.next += 1;
    }

    /// Adds a button to the message that was reported last.
    pub fn answer_last(&mut self, answer: MessageAnswer) {
        if let Some(last) = self.list.last_mut() {
            last.answer = Some(answer);
        }
    }

    /// Removes a message.
    pub fn dismiss(&mut self, id: u64) {
        self.list.retain(|message| message.id != id);
    }

    /// Removes all messages.
    pub fn dismiss_all(&mut self) {
        self.list.clear();
    }

    /// Removes the messages of a cause that is gone.
    pub fn clear(&mut self, cause: MessageCause) {
        self.list.retain(|message| message.cause != cause);
    }

    /// Removes the messages of a cause that begin with this file's name, because the file is read again.
    pub fn clear_of_file(&mut self, cause: MessageCause, file: &str) {
        let is_about = |text: &str| text.strip_prefix(file).is_some_and(|rest| rest.starts_with(':'));
        self.list.retain(|message| message.cause != cause || !is_about(&message.text));
    }

    /// Removes the messages with this text, which no longer hold.
    pub fn withdraw(&mut self, text: &str) {
        self.list.retain(|message| message.text != text);
    }

    /// The messages, the oldest first.
    pub fn list(&self) -> &[UserMessage] {
        &self.list
    }

    /// The messages as they are shown: those about one file together, the group of the newest message first, and within
    /// a group in their order.
    pub fn grouped(&self) -> Vec<(Option<&str>, Vec<&UserMessage>)> {
        let mut groups: Vec<(Option<&str>, Vec<&UserMessage>)> = Vec::new();
        for message in self.list.iter().rev() {
            let file = message.file.as_deref();
            match groups.iter_mut().find(|(known, _)| file.is_some() && *known == file) {
                Some((_, group)) => group.insert(0, message),
                None => groups.push((file, vec![message])),
            }
        }
        groups
    }

    /// The last error that has not been dismissed.
    pub fn last_error(&self) -> Option<&str> {
        self.list.iter().rev().find(|m| m.severity == MessageSeverity::Error).map(|m| m.text.as_str())
    }

    /// The id of the next message: it differs between two moments if one was reported between them.
    pub fn count(&self) -> u64 {
        self.next
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_stay_until_dismissed_and_repeats_are_counted() {
        let mut messages = Messages::default();
        messages.report(MessageSeverity::Error, "no such file");
        messages.report(MessageSeverity::Note, "lit by its own light");
        messages.report(MessageSeverity::Error, "no such file");
        let shown: Vec<(&str, u32)> = messages.list().iter().map(|m| (m.text.as_str(), m.times)).collect();
        assert_eq!(shown, [("lit by its own light", 1), ("no such file", 2)], "a repeated one is the newest");
        assert_eq!(messages.last_error(), Some("no such file"));
        messages.dismiss(messages.list()[1].id);
        assert_eq!((messages.last_error(), messages.list().len()), (None, 1));
    }

    #[test]
    fn a_cause_that_is_gone_takes_its_messages_along() {
        let mut messages = Messages::default();
        let causes = [MessageCause::Event, MessageCause::Opening, MessageCause::Scene];
        for cause in causes {
            messages.report_about(cause, MessageSeverity::Warning, None, format!("{cause:?}"));
        }
        messages.clear(MessageCause::Scene);
        messages.clear(MessageCause::Closing);
        let left: Vec<&str> = messages.list().iter().map(|message| message.text.as_str()).collect();
        assert_eq!(left, ["Event", "Opening"]);
        for text in ["a.glsl: no main", "b.glsl: no main"] {
            messages.report_about(MessageCause::BenchFiles, MessageSeverity::Error, None, text);
        }
        messages.clear_of_file(MessageCause::BenchFiles, "a.glsl");
        assert_eq!(messages.list().len(), 3);
        assert_eq!(messages.last_error(), Some("b.glsl: no main"));
    }

    #[test]
    fn messages_about_a_file_are_together_and_the_newest_group_is_first() {
        let mut messages = Messages::default();
        let reported = [(Some("a.mtl"), "1"), (None, "2"), (Some("b.obj"), "3"), (Some("a.mtl"), "4"), (None, "5")];
        for (file, text) in reported {
            messages.report_about(MessageCause::Scene, MessageSeverity::Warning, file.map(str::to_owned), text);
        }
        let shown: Vec<(Option<&str>, Vec<&str>)> = messages
            .grouped()
            .into_iter()
            .map(|(file, group)| (file, group.into_iter().map(|message| message.text.as_str()).collect()))
            .collect();
        let expected =
            [(None, vec!["5"]), (Some("a.mtl"), vec!["1", "4"]), (Some("b.obj"), vec!["3"]), (None, vec!["2"])];
        assert_eq!(shown, expected);
    }
}
