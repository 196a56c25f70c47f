"""Work in a process with one thread: pytest-xdist's own thread takes memory too, whenever it is sent something."""

import multiprocessing


def alone(work):
    """What `work()` gives, from a process of its own.

    Raises
    ------
    EOFError
        When it gave nothing; its error is on stderr.
    """
    fork = multiprocessing.get_context("fork")
    receives, sends = fork.Pipe(duplex=False)
    process = fork.Process(target=lambda: sends.send(work()))
    process.start()
    sends.close()
    with receives:
        given = receives.recv()
    process.join()
    process.close()
    return given
