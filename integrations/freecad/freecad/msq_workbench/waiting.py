# SPDX-License-Identifier: Apache-2.0
"""Long calls: their progress, and a way to cancel them."""
import threading

import FreeCAD

from .library import msq

_MILLISECONDS_UNTIL_SHOWN = 400

_running = []  # jobs, the innermost last
_lock = threading.Lock()


def cancel():
    """Cancels the call that is running, which then raises msq.CancelledError. For any thread.
    Returns whether one was running."""
    with _lock:
        for job in _running:
            job.cancel()
        return bool(_running)


def run(label, call):
    """Returns call(job). With a window the call is made on another thread, while a dialog shows
    its progress and a button that cancels it; without one an interrupt from the keyboard does."""
    job = msq().Job()
    with _lock:
        _running.append(job)
    try:
        return _run_with_dialog(label, call, job) if FreeCAD.GuiUp else call(job)
    finally:
        with _lock:
            _running.remove(job)


def _run_with_dialog(label, call, job):
    import FreeCADGui
    from PySide import QtCore, QtGui

    done, results, errors = threading.Event(), [], []

    def work():
        try:
            results.append(call(job))
        except BaseException as error:  # raised below, on the thread that asked
            errors.append(error)
        finally:
            done.set()

    dialog = QtGui.QProgressDialog(label, "Cancel", 0, 1000, FreeCADGui.getMainWindow())
    dialog.setWindowTitle("msq")
    dialog.setWindowModality(QtCore.Qt.ApplicationModal)  # so that nothing changes the document
    dialog.setMinimumDuration(_MILLISECONDS_UNTIL_SHOWN)
    dialog.setAutoReset(False)
    thread = threading.Thread(target=work, name="msq")
    thread.start()
    try:
        while not done.wait(0.03):
            if dialog.wasCanceled():
                job.cancel()
            else:
                dialog.setValue(min(int(1000 * job.progress), 999))
            QtGui.QApplication.processEvents()
    finally:
        if not done.is_set():
            job.cancel()
        thread.join()
        dialog.close()
        dialog.deleteLater()
    if errors:
        raise errors.pop()
    return results.pop()
