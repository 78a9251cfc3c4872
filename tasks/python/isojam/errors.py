"""What can go wrong, with where and what is allowed."""


class InputError(ValueError):
    """A file that is not as it should be, or something asked for that is not there.

    file: its path; place: a JSON pointer, a line or a column, "" for the whole; why: what is wrong; allowed: what would
    have been right, "" if that is plain."""

    def __init__(self, file, place, why, allowed=""):
        self.file, self.place, self.why, self.allowed = str(file), place, why, allowed
        text = f"{self.file}: {place}: {why}" if place else f"{self.file}: {why}"
        super().__init__(text + (f"; allowed: {allowed}" if allowed else ""))


class ProgramError(RuntimeError):
    """The program isojam was not found, or ended with an error.

    command: as a list of words; message: what it said on stderr."""

    def __init__(self, command, message):
        self.command, self.message = [str(word) for word in command], message
        super().__init__(f"{' '.join(self.command)}: {message}" if command else message)
