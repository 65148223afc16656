from .document import Report as Report
from .document import page as page
from .document import write_report as write_report
from .gallery import write_gallery as write_gallery
from .looking import look_at as look_at
from .photo_report import PhotoReport as PhotoReport
from .photo_report import photo_report as photo_report
